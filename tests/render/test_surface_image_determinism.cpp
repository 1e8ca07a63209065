// A ray-cast picture has the same bits and costs the same work however it is cut up.
#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <random>
#include <vector>

#include "src/integrate/surface_image.h"
#include "src/render/render.h"
#include "tests/support/surfaces.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::render;
using scene::EstimatorKind;

namespace {

constexpr Rect kFrame{0, 0, 64, 36};

scene::Scene small_scene(solid::Kind kind) {
    scene::Scene scene = support::small_scene(kind, kFrame.x1, kFrame.y1);
    scene.sky.haze_distance = 30.0;
    if (support::is_bounded(scene.surface)) {
        scene.surface.spin_deg_per_s = 50.0;
        scene.shutter.open_s = 0.05;
    }
    // Everything that can move does, somewhere.
    if (kind != solid::kKind<solid::HeightField>) scene.surface.drift = {0.3, -0.2, 0.5};
    if (kind == solid::kKind<solid::DisplacedPlane> || kind == solid::kKind<solid::LevelSet>) {
        scene.shutter.open_s = 0.05;
        const glm::dvec3 from = scene.camera.position, to = scene.camera.look_at;
        scene.camera.keys = {{.time_s = -0.1, .position = from, .look_at = to, .fov_deg = 40.0},
                             {.time_s = 0.1, .position = from + glm::dvec3(0.1), .look_at = 0.9 * to, .fov_deg = 55.0}};
    }
    return scene;
}

RenderResult render_scene(const scene::Scene& scene, const Rect& window, int threads, int tile) {
    RenderOptions options;
    options.threads = threads;
    options.tile = tile;
    return render::render(SurfaceImage(scene, Tracer::fast), Estimator(estimator_settings(scene)), window, options);
}

int differing(const Film& part, const Film& whole) {
    int count = 0;
    const Rect& window = part.window();
    for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x) {
            count += std::memcmp(&part.at(x, y), &whole.at(x, y), sizeof(glm::vec3)) != 0;
        }
    }
    return count;
}

bool same_work(const PhaseCost& a, const PhaseCost& b) {
    return a.noise_evaluations == b.noise_evaluations && a.steps == b.steps;
}

// All but that of beams, which the samples of a batch share, and executed_lanes, which counts idle lanes too.
bool same_work(const Counters& a, const Counters& b) {
    bool same = a.rays == b.rays && a.shadow_rays == b.shadow_rays && a.hits == b.hits &&
                a.unresolved_rays == b.unresolved_rays;
    for (const Phase phase : {Phase::rays, Phase::normals, Phase::shadows}) {
        const auto i = static_cast<std::size_t>(phase);
        same = same && same_work(a.phases[i], b.phases[i]);
    }
    return same;
}

struct Samples {
    std::vector<double> u, v, t;
    SampleBatch batch(std::size_t first, std::size_t count) const {
        return {std::span(u).subspan(first, count), std::span(v).subspan(first, count),
                std::span(t).subspan(first, count)};
    }
};

Samples random_samples(std::mt19937_64& random, std::size_t count) {
    Samples samples;
    std::uniform_real_distribution<double> u(-4.0, 68.0), v(-4.0, 40.0), t(0.0, 0.05);
    for (std::size_t i = 0; i < count; ++i) {
        samples.u.push_back(u(random));
        samples.v.push_back(v(random));
        samples.t.push_back(t(random));
    }
    return samples;
}

}  // namespace

TEST_CASE("a surface's picture and its work are the same for any threads, tiles and crops, shadows on") {
    constexpr std::array<Rect, 4> kCrops{{{0, 0, 64, 36}, {5, 3, 38, 22}, {63, 0, 64, 36}, {30, 17, 31, 18}}};

    for (const solid::Kind kind : {solid::kKind<solid::HeightField>, solid::kKind<solid::LevelSet>}) {
        for (const EstimatorKind estimator : {EstimatorKind::none, EstimatorKind::stratified, EstimatorKind::shared}) {
            scene::Scene scene = small_scene(kind);
            scene.sampling.estimator = estimator;
            const RenderResult whole = render_scene(scene, kFrame, 1, 64);
            REQUIRE(whole.film.complete());
            REQUIRE(whole.counters.hits > 0);
            REQUIRE(whole.counters.shadow_rays > 0);
            REQUIRE(whole.counters.unresolved_rays == 0);
            int variant = 0;
            for (const int threads : {1, 2, 3, 7}) {
                for (const int tile : {8, 16, 33, 64}) {
                    CAPTURE(threads);
                    CAPTURE(tile);
                    const Rect& crop = kCrops[static_cast<std::size_t>(variant++) % kCrops.size()];
                    const RenderResult part = render_scene(scene, crop, threads, tile);
                    CHECK(differing(part.film, whole.film) == 0);
                    if (crop != kFrame) continue;
                    CHECK(same_work(part.counters, whole.counters));
                }
            }
            const RenderResult tiled = render_scene(scene, kFrame, 7, 8);
            CHECK(differing(tiled.film, whole.film) == 0);
            CHECK(same_work(tiled.counters, whole.counters));
            if (estimator != EstimatorKind::shared) {
                CHECK(whole.counters.rays == 64u * 36u * (estimator == EstimatorKind::none ? 1u : 4u));
            }
            MESSAGE("executed lanes " << whole.counters.executed_lanes << " in one tile, "
                                      << tiled.counters.executed_lanes << " in tiles of 8");
        }
    }
}

TEST_CASE("a sample's radiance and work do not depend on the rest of its batch") {
    std::mt19937_64 random(3);
    for (const solid::Kind kind : support::all_kinds()) {
        for (const Tracer tracer : {Tracer::fast, Tracer::reference}) {
            scene::Scene scene = small_scene(kind);
            if (tracer == Tracer::reference) scene.surface.octaves = 2;
            const SurfaceImage image(scene, tracer);
            const Samples samples = random_samples(random, tracer == Tracer::fast ? 3000 : 300);
            const std::size_t count = samples.u.size();
            std::vector<glm::vec3> whole(count), parts(count);
            Counters whole_work, parts_work;
            image.evaluate(samples.batch(0, count), whole, whole_work);
            for (std::size_t begin = 0, size = 1; begin < count; begin += size, size = 1 + random() % 90) {
                size = std::min(size, count - begin);
                image.evaluate(samples.batch(begin, size), std::span(parts).subspan(begin, size), parts_work);
            }
            CHECK(std::memcmp(whole.data(), parts.data(), count * sizeof(glm::vec3)) == 0);
            CHECK(same_work(whole_work, parts_work));
            CHECK(whole_work.hits > count / 20);
        }
    }
}
