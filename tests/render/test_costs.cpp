// What pixels cost: accounts that add up to the counters, and cost nothing when they are not asked for.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

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

constexpr Rect kFrame{0, 0, 48, 70};

scene::Scene small_scene(solid::Kind kind, EstimatorKind estimator) {
    scene::Scene scene = support::small_scene(kind, kFrame.x1, kFrame.y1);
    scene.sampling.estimator = estimator;
    scene.surface.octaves = 4;
    return scene;
}

ChannelSet costs() {
    const std::array asked{find_channel("steps"), find_channel("evals")};
    return ChannelSet(asked);
}

RenderResult render_scene(const scene::Scene& scene, const Rect& window, int threads, int tile, bool with_costs,
                          Tracer tracer = Tracer::fast) {
    RenderOptions options;
    options.threads = threads;
    options.tile = tile;
    if (with_costs) options.channels = costs();
    return render::render(SurfaceImage(scene, tracer), Estimator(estimator_settings(scene)), window, options);
}

// Of steps and evals, which films hold side by side.
glm::dvec2 sum(const std::vector<float>& costs) {
    glm::dvec2 total(0.0);
    for (std::size_t i = 0; i < costs.size(); i += 2) total += glm::dvec2(costs[i], costs[i + 1]);
    return total;
}

// Steps and noise evaluations of the samples' own: all but those of beams and windows.
glm::dvec2 own_work(const Counters& counters) {
    glm::dvec2 own(counters.steps, counters.noise_evaluations);
    for (const Phase shared : {Phase::beams, Phase::windows, Phase::sun_beams}) {
        const PhaseCost& cost = counters.phases[static_cast<std::size_t>(shared)];
        own -= glm::dvec2(cost.steps, cost.noise_evaluations);
    }
    return own;
}

}  // namespace

TEST_CASE("the costs of all pixels are all steps and evaluations of rays, normals and shadows that were counted") {
    for (const solid::Kind kind : support::all_kinds()) {
        for (const Tracer tracer : {Tracer::fast, Tracer::reference}) {
            const RenderResult result =
                render_scene(small_scene(kind, EstimatorKind::stratified), kFrame, 2, 16, true, tracer);
            REQUIRE(result.counters.shadow_rays > 0);
            const glm::dvec2 total = 4.0 * sum(result.film.channels());
            // Four samples a pixel: means are exact in float.
            CHECK(total == own_work(result.counters));
        }
    }
}

TEST_CASE("costs of shared samples are those of a pixel's own cell, whatever the order of the filter") {
    for (const solid::Kind kind : support::all_kinds()) {
        scene::Scene scene = small_scene(kind, EstimatorKind::shared);
        scene.sampling.m = 1;  // no sample reaches another pixel: no cells beyond the frame
        const RenderResult own = render_scene(scene, kFrame, 1, 32, true);
        CHECK(4.0 * sum(own.film.channels()) == own_work(own.counters));
        for (const int m : {4, 9, 100}) {
            scene.sampling.m = m;
            const RenderResult shared = render_scene(scene, kFrame, 3, 32, true);
            CHECK(shared.film.channels() == own.film.channels());
            CHECK(shared.counters.steps >= own.counters.steps);
        }
    }
}

TEST_CASE("costs do not depend on threads, tiles and crop, and change no pixel") {
    for (const EstimatorKind estimator :
         {EstimatorKind::none, EstimatorKind::stratified, EstimatorKind::shared_sobol}) {
        const scene::Scene scene = small_scene(solid::kKind<solid::DisplacedPlane>, estimator);
        const RenderResult whole = render_scene(scene, kFrame, 1, 32, true);
        const RenderResult plain = render_scene(scene, kFrame, 1, 32, false);
        CHECK(plain.film.channels().empty());
        CHECK(plain.film.pixels() == whole.film.pixels());
        CHECK(plain.counters.noise_evaluations == whole.counters.noise_evaluations);
        CHECK(render_scene(scene, kFrame, 4, 7, true).film.channels() == whole.film.channels());
        const Rect crop{5, 9, 31, 66};
        const RenderResult part = render_scene(scene, crop, 2, 16, true);
        int wrong = 0;
        for (int y = crop.y0; y < crop.y1; ++y) {
            for (int x = crop.x0; x < crop.x1; ++x) {
                wrong += std::ranges::equal(part.film.channels_at(x, y), whole.film.channels_at(x, y)) ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
    }
}
