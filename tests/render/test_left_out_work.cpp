// What a scene does not use is not done: its counts are those of a scene that does not name it.
#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "tests/support/surfaces.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::render;

namespace {

constexpr Rect kFrame{0, 0, 32, 18};

scene::Scene small_scene(solid::Kind kind) {
    scene::Scene scene = support::small_scene(kind, kFrame.x1, kFrame.y1);
    scene.sampling.estimator = scene::EstimatorKind::stratified;
    scene.surface.shape<solid::Sphere>().radius = 1.0;
    return scene;
}

// One thread and one tile: idle lanes are the same in every run.
RenderResult render_scene(const scene::Scene& scene) {
    RenderOptions options;
    options.threads = 1;
    options.tile = 64;
    return render::render(*make_image(scene), Estimator(estimator_settings(scene)), kFrame, options);
}

void check_same_counts(const Counters& a, const Counters& b) {
    for (const auto& [name, count] : kCounters) {
        CAPTURE(name);
        CHECK(a.*count == b.*count);
    }
}

void check_same_render(const scene::Scene& a, const scene::Scene& b) {
    const RenderResult from_a = render_scene(a), from_b = render_scene(b);
    check_same_counts(from_a.counters, from_b.counters);
    const auto& pixels = from_a.film.pixels();
    CHECK(std::memcmp(pixels.data(), from_b.film.pixels().data(), pixels.size() * sizeof(glm::vec3)) == 0);
}

SampleSet samples_of(const scene::Scene& scene) {
    const Estimator estimator(estimator_settings(scene));
    const std::vector<glm::ivec2> pixels{{3, 4}, {5, 6}};
    SampleSet set;
    if (estimator.shared()) {
        estimator.cell_samples(pixels, set);
    } else {
        estimator.pixel_samples(pixels, set);
    }
    return set;
}

}  // namespace

TEST_CASE("an open shutter over a scene at rest draws no times and costs what an instant does") {
    for (const solid::Kind kind : support::all_kinds()) {
        scene::Scene still = small_scene(kind), open = still;
        open.shutter.open_s = 0.03;
        open.sampling.time_order = 4;
        check_same_render(open, still);
        const SampleSet set = samples_of(open);
        CHECK(set.scratch_permutation.empty());
        for (const double t : set.t) CHECK(t == 0.015);
        open.surface.spin_deg_per_s = 1.0;
        CHECK(!samples_of(open).scratch_permutation.empty());
    }
}

TEST_CASE("camera keys at rest cost what a camera without keys does") {
    for (const solid::Kind kind : support::all_kinds()) {
        scene::Scene still = small_scene(kind), keyed = still;
        const scene::Camera& camera = still.camera;
        keyed.camera.keys = {{.time_s = 0.0, .position = camera.position, .look_at = camera.look_at},
                             {.time_s = 1.0, .position = camera.position + glm::dvec3(1.0, 0.0, 0.0)}};
        keyed.shutter.open_s = 0.0;  // at the first key
        check_same_render(keyed, still);
        keyed.camera.keys = {{.time_s = -1.0}, {.time_s = 1.0}, {.time_s = 9.0, .fov_deg = 20.0}};
        keyed.shutter.open_s = 0.03;
        CHECK(samples_of(keyed).scratch_permutation.empty());
        const Counters found = render_scene(keyed).counters;
        CHECK(found.rays == render_scene(still).counters.rays);
    }
}

TEST_CASE("a spin and a drift cost no evaluations at an instant, nor does a rate of zero at any time") {
    for (const solid::Kind kind : support::all_kinds()) {
        const scene::Scene still = small_scene(kind);
        scene::Scene spinning = still;
        spinning.surface.spin_deg_per_s = 40.0;  // at t = 0
        check_same_render(spinning, still);
        scene::Scene drifting = still;
        drifting.surface.drift = {0.3, 0.2, -0.1};
        check_same_render(drifting, still);
        scene::Scene later = still;
        later.shutter.frame = 0;
        later.shutter.open_s = 0.01;
        later.surface.spin_axis = {1.0, 2.0, 3.0};
        check_same_render(later, still);
    }
}

TEST_CASE("a height field's noise has two dimensions: a drift along the third changes and costs nothing") {
    scene::Scene still = small_scene(solid::kKind<solid::HeightField>), drifting = still;
    drifting.surface.drift = {0.0, 5.0, 0.0};
    drifting.shutter = {.fps = 25.0, .open_s = 0.03, .frame = 0};
    check_same_render(drifting, still);
    CHECK(samples_of(drifting).scratch_permutation.empty());
}

TEST_CASE("without shadows the noise is evaluated for camera rays and the normals of their hits alone") {
    for (const solid::Kind kind : support::all_kinds()) {
        for (int way = 0; way < 3; ++way) {
            scene::Scene scene = small_scene(kind);
            if (way == 0) scene.sun.shadows = false;
            if (way == 1) scene.sun.intensity = 0.0;
            if (way == 2) scene.sun.colour = glm::dvec3(0.0);
            const Counters counters = render_scene(scene).counters;
            CHECK(counters.shadow_rays == 0);

            const SurfaceImage image(scene, Tracer::fast);
            const Estimator estimator(estimator_settings(scene));
            std::vector<glm::ivec2> pixels;
            for (int y = 0; y < 18; ++y) {
                for (int x = 0; x < 32; ++x) pixels.emplace_back(x, y);
            }
            SampleSet set;
            estimator.pixel_samples(pixels, set);
            std::vector<trace::Ray> rays;
            for (std::size_t i = 0; i < set.u.size(); ++i) {
                rays.push_back(image.local_camera_ray(set.u[i], set.v[i], 0.0));
            }
            std::vector<trace::Hit> hits(rays.size());
            trace::TraceCounters traced;
            image.trace(rays, hits, traced);
            std::uint64_t found = 0, missing = 0;
            for (const trace::Hit& hit : hits) {
                if (hit.state != trace::HitState::hit) continue;
                ++found;
                missing += 5 - hit.octaves;
                CHECK((!hit.on_bound || hit.octaves == 5));
            }
            CHECK(counters.hits == found);
            const auto cost = [&](Phase phase) { return counters.phases[static_cast<std::size_t>(phase)]; };
            for (const Phase phase : {Phase::sun_beams, Phase::shadows, Phase::shading}) {
                CHECK(cost(phase).steps == 0);
                CHECK(cost(phase).noise_evaluations == 0);
            }
            CHECK(cost(Phase::rays).steps <= traced.steps);
            CHECK(cost(Phase::normals).noise_evaluations <= 2 * missing);
        }
    }
}

TEST_CASE("haze casts no rays and evaluates no noise") {
    for (const solid::Kind kind : support::all_kinds()) {
        scene::Scene clear = small_scene(kind), hazy = clear;
        hazy.sky.haze_distance = 20.0;
        check_same_counts(render_scene(hazy).counters, render_scene(clear).counters);
        // Its absence is exact: no haze is the limit of thin haze.
        hazy.sky.haze_distance = 1e30;
        check_same_render(hazy, clear);
    }
}

TEST_CASE("octaves below the last bit of a double are not evaluated") {
    scene::Scene five = small_scene(solid::kKind<solid::DisplacedPlane>);
    five.surface.gain = 1e-5;
    five.surface.octaves = 5;
    scene::Scene more = five;
    more.surface.octaves = 20;  // the sixth is 1e-25 of the first, its slope 3e-24
    check_same_render(more, five);
}

TEST_CASE("patterns cast no rays at surfaces; none takes one sample a pixel") {
    for (const scene::ImageKind kind :
         {scene::ImageKind::zoneplate, scene::ImageKind::checker, scene::ImageKind::wheel}) {
        scene::Scene scene = small_scene(solid::kKind<solid::HeightField>);
        scene.image = kind;
        const Counters counters = render_scene(scene).counters;
        CHECK(counters.rays == 32 * 18 * 4);
        CHECK(counters.hits + counters.shadow_rays + counters.noise_evaluations + counters.executed_lanes +
                  counters.steps ==
              0);
    }
    scene::Scene scene = small_scene(solid::kKind<solid::HeightField>);
    scene.sampling.estimator = scene::EstimatorKind::none;
    CHECK(render_scene(scene).counters.rays == 32 * 18);
}

TEST_CASE("an estimator holds only the tables it uses") {
    for (const scene::EstimatorRow& row : scene::all_estimators()) {
        scene::Scene scene;
        scene.sampling.estimator = row.kind;
        const Estimator estimator(estimator_settings(scene));
        using enum scene::EstimatorKind;
        const auto is = [&](auto... names) { return ((scene.sampling.estimator == names) || ...); };
        CHECK(estimator.inverts_filter() == is(stratified, random, sobol));
        CHECK(estimator.weighs_samples() == is(uniform, jittered, shared, shared_sobol));
        CHECK(estimator.shared() == is(shared, shared_sobol));
    }
}
