// Embree at a scene of strata: builds a mesh of the surface's heights and intersects the rays of the scene's estimator
// in windows of the frame, one at a time and 16 at a time, on one thread. Prints JSON. For `strata bench`:
//
//     strata_bench_embree SCENE.toml HEIGHTS VERTICES WINDOW...      WINDOW: x0,y0,x1,y1
#include <embree3/rtcore.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/estimate/estimator.h"
#include "src/film/film.h"
#include "src/parallel/cpu_clock.h"
#include "src/scene/toml_reader.h"
#include "tools/bench/peers/height_mesh.h"

namespace {

using namespace strata;

constexpr unsigned kPacket = 16;
constexpr double kMostDisagreements = 1e-3;  // of all rays: edges of triangles are rounded differently

std::atomic<std::int64_t> embree_bytes{0}, embree_peak{0};

bool count_memory(void*, ssize_t bytes, bool) {
    const std::int64_t now = embree_bytes.fetch_add(bytes) + bytes;
    std::int64_t peak = embree_peak.load();
    while (now > peak && !embree_peak.compare_exchange_weak(peak, now)) {
    }
    return true;
}

struct Directions {
    std::vector<float> x, y, z;
};

struct Tally {
    double one_s = 0, sixteen_s = 0;
    std::uint64_t rays = 0, hits = 0;
    std::uint64_t disagreements = 0;       // of the two ways, on whether a ray hits
    std::uint64_t compared = 0, same = 0;  // with the surface itself: the same outcome, within a pixel's width

    void add(const Tally& other) {
        one_s += other.one_s;
        sixteen_s += other.sixteen_s;
        rays += other.rays;
        hits += other.hits;
        disagreements += other.disagreements;
        compared += other.compared;
        same += other.same;
    }
};

class Bench {
  public:
    Bench(const scene::Scene& scene, RTCScene mesh, const integrate::SurfaceImage& image)
        : scene_(scene), mesh_(mesh), image_(image), estimator_(estimate::estimator_settings(scene)) {}

    Tally measure(const film::Rect& window) {
        Tally tally;
        make_rays(window);
        const double start = parallel::thread_cpu_seconds();
        intersect_one();
        tally.one_s = parallel::thread_cpu_seconds() - start;
        const double middle = parallel::thread_cpu_seconds();
        intersect_sixteen();
        tally.sixteen_s = parallel::thread_cpu_seconds() - middle;
        tally.rays = distance_.size();
        for (std::size_t i = 0; i < distance_.size(); ++i) {
            tally.hits += std::isfinite(distance_[i]) ? 1 : 0;
            tally.disagreements += std::isfinite(distance_[i]) != std::isfinite(distance_of_sixteen_[i]) ? 1 : 0;
        }
        compare(tally);
        return tally;
    }

  private:
    // The estimator's own samples, pixel by pixel.
    void make_rays(const film::Rect& window) {
        std::vector<glm::ivec2> pixels;
        for (int y = window.y0; y < window.y1; ++y) {
            for (int x = window.x0; x < window.x1; ++x) pixels.emplace_back(x, y);
        }
        estimator_.pixel_samples(pixels, samples_);
        const std::size_t count = samples_.u.size();
        rays_.resize(count);
        direction_ = {std::vector<float>(count), std::vector<float>(count), std::vector<float>(count)};
        distance_.assign(count, INFINITY);
        distance_of_sixteen_.assign(count, INFINITY);
        for (std::size_t i = 0; i < count; ++i) {
            rays_[i] = image_.camera_ray(samples_.u[i], samples_.v[i], samples_.t[i]);
            direction_.x[i] = static_cast<float>(rays_[i].direction.x);
            direction_.y[i] = static_cast<float>(rays_[i].direction.y);
            direction_.z[i] = static_cast<float>(rays_[i].direction.z);
        }
    }

    RTCIntersectContext coherent() const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        return context;
    }

    void intersect_one() {
        RTCIntersectContext context = coherent();
        const glm::vec3 origin(scene_.camera.position);
        const auto far = static_cast<float>(scene_.camera.far);
        for (std::size_t i = 0; i < distance_.size(); ++i) {
            RTCRayHit ray{};
            ray.ray.org_x = origin.x;
            ray.ray.org_y = origin.y;
            ray.ray.org_z = origin.z;
            ray.ray.dir_x = direction_.x[i];
            ray.ray.dir_y = direction_.y[i];
            ray.ray.dir_z = direction_.z[i];
            ray.ray.tfar = far;
            ray.ray.mask = ~0u;
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(mesh_, &context, &ray);
            if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) distance_[i] = ray.ray.tfar;
        }
    }

    // The same rays; what is left of a packet stays away.
    void intersect_sixteen() {
        RTCIntersectContext context = coherent();
        const glm::vec3 origin(scene_.camera.position);
        const auto far = static_cast<float>(scene_.camera.far);
        alignas(64) std::array<int, kPacket> valid;
        for (std::size_t first = 0; first < distance_.size(); first += kPacket) {
            RTCRayHit16 packet;
            for (unsigned lane = 0; lane < kPacket; ++lane) {
                const std::size_t i = first + lane;
                valid[lane] = i < distance_.size() ? -1 : 0;
                if (valid[lane] == 0) continue;
                packet.ray.org_x[lane] = origin.x;
                packet.ray.org_y[lane] = origin.y;
                packet.ray.org_z[lane] = origin.z;
                packet.ray.dir_x[lane] = direction_.x[i];
                packet.ray.dir_y[lane] = direction_.y[i];
                packet.ray.dir_z[lane] = direction_.z[i];
                packet.ray.tnear[lane] = 0.0f;
                packet.ray.tfar[lane] = far;
                packet.ray.time[lane] = 0.0f;
                packet.ray.mask[lane] = ~0u;
                packet.ray.id[lane] = 0;
                packet.ray.flags[lane] = 0;
                packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
                packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
            }
            rtcIntersect16(valid.data(), mesh_, &context, &packet);
            for (unsigned lane = 0; lane < kPacket && first + lane < distance_.size(); ++lane) {
                const bool hit = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
                distance_of_sixteen_[first + lane] = hit ? packet.ray.tfar[lane] : INFINITY;
            }
        }
    }

    // Every 16th ray with the surface itself.
    void compare(Tally& tally) const {
        std::vector<trace::Ray> rays;
        std::vector<float> distance;
        const glm::dmat3 orientation = image_.placement().orientation(0.0);
        for (std::size_t i = 0; i < rays_.size(); i += kPacket) {
            rays.push_back(image_.to_local(orientation, rays_[i], 0.0));
            distance.push_back(distance_[i]);
        }
        std::vector<trace::Hit> hits(rays.size());
        trace::TraceCounters counters;
        image_.trace(rays, hits, counters);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool hit = hits[i].state == trace::HitState::hit;
            const auto t = static_cast<double>(distance[i]);
            const double pixel = rays[i].delta_slope / scene_.sampling.tolerance * hits[i].s;
            const bool same = hit ? std::abs(t - hits[i].s) <= pixel : !std::isfinite(t);
            tally.same += same ? 1 : 0;
        }
        tally.compared += rays.size();
    }

    const scene::Scene& scene_;
    RTCScene mesh_;
    const integrate::SurfaceImage& image_;
    estimate::Estimator estimator_;
    estimate::SampleSet samples_;
    std::vector<trace::Ray> rays_;
    Directions direction_;
    std::vector<float> distance_, distance_of_sixteen_;  // infinite: no hit
};

film::Rect parse_window(const std::string& text) {
    film::Rect w;
    if (std::sscanf(text.c_str(), "%d,%d,%d,%d", &w.x0, &w.y0, &w.x1, &w.y1) != 4) {
        throw std::runtime_error(text + ": a window is x0,y0,x1,y1");
    }
    return w;
}

nlohmann::ordered_json run(const std::vector<std::string>& words) {
    const scene::Scene scene = scene::load_scene(words[0]);
    const integrate::SurfaceImage image(scene, integrate::Tracer::fast);
    const tools::bench::HeightGrid grid = tools::bench::sample_heights(image, scene, std::stoi(words[2]), words[1]);
    RTCDevice device = rtcNewDevice(nullptr);
    rtcSetDeviceMemoryMonitorFunction(device, count_memory, nullptr);
    const auto start = std::chrono::steady_clock::now();
    RTCScene mesh = tools::bench::build_mesh(device, grid);
    const double build_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Bench bench(scene, mesh, image);
    Tally tally;
    for (std::size_t i = 3; i < words.size(); ++i) tally.add(bench.measure(parse_window(words[i])));
    const tools::bench::HeightError error = tools::bench::height_error(image, grid);
    rtcReleaseScene(mesh);
    rtcReleaseDevice(device);
    const auto rays = static_cast<double>(tally.rays);
    if (static_cast<double>(tally.disagreements) > kMostDisagreements * rays) {
        throw std::runtime_error("one ray at a time and 16 at a time do not hit the same");
    }
    return {{"rays", tally.rays},
            {"hits", tally.hits},
            {"one_ns", 1e9 * tally.one_s / rays},
            {"sixteen_ns", 1e9 * tally.sixteen_s / rays},
            {"build_s", build_s},
            {"memory_bytes", embree_bytes.load() >= 0 ? embree_peak.load() : 0},
            {"height_error_rms", error.rms},
            {"height_error_max", error.greatest},
            {"same_share", static_cast<double>(tally.same) / static_cast<double>(tally.compared)}};
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() < 4) {
        std::fputs("usage: strata_bench_embree SCENE.toml HEIGHTS VERTICES x0,y0,x1,y1...\n", stderr);
        return 2;
    }
    try {
        std::printf("%s\n", run(words).dump().c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "strata_bench_embree: %s\n", error.what());
        return 1;
    }
    return 0;
}
