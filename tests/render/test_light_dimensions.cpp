// Soft sun and sky rays draw from further dimensions of each sample: bits and counts are still those of the sample
// alone, and the noise falls as that of stratified samples does.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "src/integrate/surface_image.h"
#include "src/render/render.h"

using namespace strata;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::render;
using scene::EstimatorKind;

namespace {

constexpr Rect kFrame{0, 0, 40, 24};

scene::Scene small_scene(solid::Kind kind, EstimatorKind estimator) {
    scene::Scene scene;
    scene.film = {.width = kFrame.x1, .height = kFrame.y1};
    scene.sampling.N = 2;
    scene.sampling.estimator = estimator;
    scene.surface.kind = kind;
    scene.surface.octaves = 4;
    scene.surface.amplitude = 1.0;
    scene.surface.shape<solid::Sphere>().radius = 2.0;
    scene.camera.far = 60.0;
    scene.camera.position = {0.0, 1.6, 0.0};
    scene.sun.angular_radius_deg = 2.0;
    scene.sky.light = scene::SkyLight::rays;
    scene.sky.bounces = 2;
    if (kind == solid::kKind<solid::Sphere>) {
        scene.camera.position = {0.5, 1.0, -6.0};
        scene.camera.look_at = glm::dvec3(0.0);
        scene.surface.spin_deg_per_s = 50.0;
        scene.shutter.open_s = 0.05;
    }
    return scene;
}

RenderResult render_scene(const scene::Scene& scene, const Rect& window, int threads, int tile,
                          bool with_costs = false) {
    RenderOptions options;
    options.threads = threads;
    options.tile = tile;
    if (with_costs) {
        const std::array asked{find_channel("steps"), find_channel("evals")};
        options.channels = ChannelSet(asked);
    }
    return render::render(SurfaceImage(scene, Tracer::fast), estimate::Estimator(estimate::estimator_settings(scene)),
                          window, options);
}

int differing(const Film& part, const Film& whole) {
    int count = 0;
    const Rect& window = part.window();
    for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x)
            count += std::memcmp(&part.at(x, y), &whole.at(x, y), sizeof(glm::vec3)) != 0;
    }
    return count;
}

}  // namespace

TEST_CASE("soft sun, sky rays and reflections: the same bits and counts for any threads, tiles and crops") {
    constexpr std::array<Rect, 3> kCrops{{{0, 0, 40, 24}, {5, 3, 28, 22}, {30, 17, 31, 18}}};
    for (const solid::Kind kind : {solid::kKind<solid::HeightField>, solid::kKind<solid::Sphere>}) {
        for (const EstimatorKind estimator :
             {EstimatorKind::none, EstimatorKind::super, EstimatorKind::stratified, EstimatorKind::shared_sobol}) {
            const scene::Scene scene = small_scene(kind, estimator);
            const RenderResult whole = render_scene(scene, kFrame, 1, 64);
            REQUIRE(whole.counters.sky_rays > whole.counters.hits);
            for (const int threads : {1, 3}) {
                for (const int tile : {8, 33}) {
                    for (const Rect& crop : kCrops) {
                        const RenderResult part = render_scene(scene, crop, threads, tile);
                        CHECK(differing(part.film, whole.film) == 0);
                        if (crop != kFrame) continue;
                        CHECK(part.counters.sky_rays == whole.counters.sky_rays);
                        CHECK(part.counters.shadow_rays == whole.counters.shadow_rays);
                        for (const Phase phase : {Phase::sky_rays, Phase::bounces}) {
                            const auto i = static_cast<std::size_t>(phase);
                            CHECK(part.counters.phases[i].steps == whole.counters.phases[i].steps);
                            CHECK(part.counters.phases[i].noise_evaluations ==
                                  whole.counters.phases[i].noise_evaluations);
                        }
                    }
                }
            }
        }
    }
}

TEST_CASE("what sky rays cost is in the pixels' costs, which add up to what was counted") {
    const scene::Scene scene = small_scene(solid::kKind<solid::HeightField>, EstimatorKind::stratified);
    const RenderResult result = render_scene(scene, kFrame, 2, 16, true);
    glm::dvec2 own(result.counters.steps, result.counters.noise_evaluations), costs(0.0);
    for (const Phase shared : {Phase::beams, Phase::windows, Phase::sun_beams}) {
        const PhaseCost& cost = result.counters.phases[static_cast<std::size_t>(shared)];
        own -= glm::dvec2(cost.steps, cost.noise_evaluations);
    }
    for (std::size_t i = 0; i < result.film.channels().size(); i += 2) {
        costs += 4.0 * glm::dvec2(result.film.channels()[i], result.film.channels()[i + 1]);
    }
    CHECK(costs == own);
    CHECK(result.counters.phases[static_cast<std::size_t>(Phase::sky_rays)].steps > 0);
    CHECK(result.counters.phases[static_cast<std::size_t>(Phase::bounces)].steps > 0);
}

// Of the light alone: still ground of one colour under a sky of two. Independent directions would halve the deviation
// from N = 2 to N = 4 and again to N = 8; those that are stratified over a pixel's samples do better.
TEST_CASE("the noise of sky light falls faster than that of independent directions") {
    const auto deviation = [](int N) {
        scene::Scene scene = small_scene(solid::kKind<solid::HeightField>, EstimatorKind::stratified);
        scene.surface.amplitude = 0.0;
        scene.sun.intensity = 0.0;
        scene.sky.horizon = {1.0, 1.0, 1.0};
        scene.sky.zenith = {0.0, 0.0, 0.0};
        scene.camera.look_at = {0.0, 0.0, 0.3};
        scene.sampling.N = N;
        const RenderResult result = render_scene(scene, kFrame, 2, 16);
        double sum = 0.0, sum2 = 0.0, count = 0.0;
        for (int y = 12; y < kFrame.y1; ++y) {
            for (int x = 0; x < kFrame.x1; ++x, ++count) {
                const double value = static_cast<double>(result.film.at(x, y).g);
                sum += value;
                sum2 += value * value;
            }
        }
        return std::sqrt(sum2 / count - sum * sum / (count * count));
    };
    const double two = deviation(2), four = deviation(4), eight = deviation(8);
    MESSAGE("standard deviations of a pixel: ", two, ", ", four, ", ", eight);
    CHECK(four < 0.4 * two);
    CHECK(eight < 0.4 * four);
}
