#include "tools/bench/peers/height_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>

#include "src/sample/sobol.h"

namespace strata::tools::bench {

namespace {

constexpr double kTolerance = 1e-6;

bool read_heights(const std::filesystem::path& cache, std::vector<float>& y) {
    std::ifstream file(cache, std::ios::binary);
    file.read(reinterpret_cast<char*>(y.data()), static_cast<std::streamsize>(y.size() * sizeof(float)));
    return static_cast<bool>(file);
}

void write_heights(const std::filesystem::path& cache, const std::vector<float>& y) {
    std::ofstream file(cache, std::ios::binary);
    file.write(reinterpret_cast<const char*>(y.data()), static_cast<std::streamsize>(y.size() * sizeof(float)));
}

// The mesh's height: each cell's diagonal runs from its corner of least x and z.
double height_at(const HeightGrid& grid, double x, double z) {
    const double u = (x - grid.x0) / (grid.x1 - grid.x0) * (grid.side - 1);
    const double v = (z - grid.z0) / (grid.z1 - grid.z0) * (grid.side - 1);
    const int column = std::clamp(static_cast<int>(u), 0, grid.side - 2);
    const int row = std::clamp(static_cast<int>(v), 0, grid.side - 2);
    const double a = u - column, b = v - row;
    const auto y = [&](int dx, int dz) {
        return static_cast<double>(grid.y[static_cast<std::size_t>(row + dz) * static_cast<std::size_t>(grid.side) +
                                          static_cast<std::size_t>(column + dx)]);
    };
    if (a >= b) return y(0, 0) + a * (y(1, 0) - y(0, 0)) + b * (y(1, 1) - y(1, 0));
    return y(0, 0) + b * (y(0, 1) - y(0, 0)) + a * (y(1, 1) - y(0, 1));
}

}  // namespace

std::vector<float> heights_from_above(const integrate::SurfaceImage& image, const std::vector<glm::dvec2>& xz) {
    const double top = image.field().amplitude() + 1e-3;
    std::vector<trace::Ray> rays(xz.size());
    for (std::size_t i = 0; i < xz.size(); ++i) {
        rays[i].origin = {xz[i].x, top, xz[i].y};
        rays[i].direction = {0.0, -1.0, 0.0};
        rays[i].limit = 2.0 * top;
        rays[i].delta0 = kTolerance;
    }
    std::vector<trace::Hit> hits(rays.size());
    trace::TraceCounters counters;
    image.trace(rays, hits, counters);
    std::vector<float> y(xz.size());
    for (std::size_t i = 0; i < xz.size(); ++i) y[i] = static_cast<float>(top - hits[i].s);
    return y;
}

HeightGrid sample_heights(const integrate::SurfaceImage& image, const scene::Scene& scene, int side,
                          const std::filesystem::path& cache) {
    const double half_width = scene.camera.far * std::sin(glm::radians(0.5 * scene.camera.fov_deg)) + 1.0;
    HeightGrid grid{.side = side,
                    .x0 = scene.camera.position.x - half_width,
                    .x1 = scene.camera.position.x + half_width,
                    .z0 = scene.camera.position.z - 0.5,
                    .z1 = scene.camera.position.z + scene.camera.far,
                    .y = std::vector<float>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
    if (read_heights(cache, grid.y)) return grid;
    std::vector<glm::dvec2> row_points(static_cast<std::size_t>(side));
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            row_points[static_cast<std::size_t>(column)] = {grid.x_at(column), grid.z_at(row)};
        }
        std::ranges::copy(heights_from_above(image, row_points), grid.y.begin() + std::ptrdiff_t{1} * row * side);
    }
    write_heights(cache, grid.y);
    return grid;
}

HeightError height_error(const integrate::SurfaceImage& image, const HeightGrid& grid) {
    constexpr std::uint32_t kPoints = 65536;
    std::vector<glm::dvec2> xz(kPoints);
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const auto point = sample::sobol_point(i);
        xz[i] = {grid.x_at(std::ldexp(point[0], -32) * (grid.side - 1)),
                 grid.z_at(std::ldexp(point[1], -32) * (grid.side - 1))};
    }
    const std::vector<float> y = heights_from_above(image, xz);
    double squares = 0;
    HeightError error;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const double off = std::abs(height_at(grid, xz[i].x, xz[i].y) - static_cast<double>(y[i]));
        squares += off * off;
        error.greatest = std::max(error.greatest, off);
    }
    error.rms = std::sqrt(squares / kPoints);
    return error;
}

RTCScene build_mesh(RTCDevice device, const HeightGrid& grid) {
    const auto side = static_cast<std::size_t>(grid.side);
    const std::size_t cells = (side - 1) * (side - 1);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(
        rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), side * side));
    for (int row = 0; row < grid.side; ++row) {
        for (int column = 0; column < grid.side; ++column) {
            *vertex++ = static_cast<float>(grid.x_at(column));
            *vertex++ = grid.y[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
            *vertex++ = static_cast<float>(grid.z_at(row));
        }
    }
    auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                      3 * sizeof(std::uint32_t), 2 * cells));
    for (std::size_t row = 0; row + 1 < side; ++row) {
        for (std::size_t column = 0; column + 1 < side; ++column) {
            const auto a = static_cast<std::uint32_t>(row * side + column);
            const auto below = static_cast<std::uint32_t>(a + side);
            for (const std::uint32_t corner : {a, a + 1, below + 1, a, below + 1, below}) *index++ = corner;
        }
    }
    rtcCommitGeometry(mesh);
    RTCScene scene = rtcNewScene(device);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene);
    return scene;
}

}  // namespace strata::tools::bench
