#include "shaders_cpu/daylight/air_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shaders_cpu/daylight/scattered_light.h"
#include "shaders_cpu/daylight/sun_table.h"

namespace strata::shaders {
namespace {

constexpr double kDeepest = 10e3;  // below the sphere: a level line's dip over 357 km
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where a line that starts at radius r crosses the sphere of the other radius: `sign` -1 the near and 1 the far
// crossing.
double crossing(double r, double up, double other, double sign) {
    const double discriminant = r * r * (up * up - 1.0) + other * other;
    return discriminant < 0.0 ? kInfinity : -r * up + sign * std::sqrt(discriminant);
}

double radius_at(double r, double up, double distance) {
    return std::sqrt(r * r + distance * (2.0 * r * up + distance));
}

// Calls use(from, to) for steps of the line from 0 to `length`, which grow as the cube of their number away from
// `lowest`.
template <class Use>
void each_step(double lowest, double length, int steps, const Use& use) {
    const double low = std::clamp(lowest, 0.0, length);
    const int down = low <= 0.0 ? 0 : low >= length ? steps : steps / 2;
    const auto cube = [](int k, int n) {
        const double x = static_cast<double>(k) / n;
        return x * x * x;
    };
    for (int k = down; k > 0; --k) use(low * (1.0 - cube(k, down)), low * (1.0 - cube(k - 1, down)));
    const int rest = steps - down;
    for (int k = 0; k < rest; ++k) use(low + (length - low) * cube(k, rest), low + (length - low) * cube(k + 1, rest));
}

// (1 - e^-x) / x: what is left, on the way out of a step of depth x, of light that arises evenly in it.
double escape(double x) { return x < 1e-5 ? 1.0 - 0.5 * x : -std::expm1(-x) / x; }

Bands escape(const Bands& x) { return {escape(x[0]), escape(x[1]), escape(x[2]), escape(x[3])}; }

}  // namespace

double horizon_up(double height) {
    const double ratio = kEarthRadius / (kEarthRadius + std::max(height, 0.0));
    return -std::sqrt(std::max(0.0, 1.0 - ratio * ratio));
}

double distance_to_ground(double height, double up) {
    if (up >= horizon_up(height)) return kInfinity;
    return std::max(0.0, crossing(kEarthRadius + height, up, kEarthRadius, -1.0));
}

double distance_to_end(double height, double up) {
    const double r = kEarthRadius + height;
    const double down = up < 0.0 ? crossing(r, up, kEarthRadius - kDeepest, -1.0) : kInfinity;
    if (down < kInfinity) return std::max(0.0, down);
    const double out = crossing(r, up, kEarthRadius + kAirTop, 1.0);
    return out < kInfinity ? std::max(0.0, out) : 0.0;
}

Densities columns_to_top(const AirModel& medium, double height, double up) {
    constexpr int kSteps = 28;
    constexpr double kGauss = 0.57735026918962576;  // 1 / sqrt(3): two points a step
    const double r = kEarthRadius + height;
    Densities sum{0.0, 0.0, 0.0};
    each_step(-r * up, distance_to_end(height, up), kSteps, [&](double from, double to) {
        const double half = 0.5 * (to - from);
        for (const double point : {0.5 * (from + to) - kGauss * half, 0.5 * (from + to) + kGauss * half}) {
            const Densities here = medium.densities(radius_at(r, up, point) - kEarthRadius);
            sum.air += here.air * half;
            sum.haze += here.haze * half;
            sum.ozone += here.ozone * half;
        }
    });
    return sum;
}

AirPath::AirPath(const AirModel& medium, double height, double up, double distance, int steps)
    : start_radius_(kEarthRadius + height), length_(std::clamp(distance, 0.0, distance_to_end(height, up))) {
    if (length_ <= 0.0) return;
    steps_.reserve(steps);
    each_step(-start_radius_ * up, length_, steps, [&](double from, double to) { add_step(medium, up, from, to); });
}

AirPath::AirPath(const AirModel& medium, double height, double up, std::span<const double> distances)
    : start_radius_(kEarthRadius + height), length_(std::min(distances.back(), distance_to_end(height, up))) {
    steps_.reserve(distances.size());
    for (std::size_t k = 1; k < distances.size(); ++k)
        add_step(medium, up, std::min(distances[k - 1], length_), std::min(distances[k], length_));
}

void AirPath::add_step(const AirModel& medium, double up, double from, double to) {
    const double length = to - from;
    const double distance = 0.5 * (from + to);
    const double radius = radius_at(start_radius_, up, distance);
    const double height = std::max(0.0, radius - kEarthRadius);
    const Densities here = medium.densities(height);
    const Densities columns{here.air * length, here.haze * length, here.ozone * length};
    const Bands full = medium.full().depth(columns);
    const Bands diffuse = medium.diffuse().depth(columns);
    const Bands diffuse_share = diffuse_transmittance_ * escape(diffuse);
    columns_.air += columns.air;
    columns_.haze += columns.haze;
    columns_.ozone += columns.ozone;
    steps_.push_back({distance, radius, horizon_up(height), SunTable::height_cell(height),
                      ScatteredLight::height_cell(height), diffuse_share * medium.full().air * columns.air,
                      diffuse_share * medium.even_haze_scattering() * columns.haze,
                      full_transmittance_ * escape(full) * medium.haze_scattering() * columns.haze, columns_});
    full_transmittance_ *= glm::exp(-full);
    diffuse_transmittance_ *= glm::exp(-diffuse);
}

}  // namespace strata::shaders
