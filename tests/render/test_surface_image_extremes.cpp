// Scenes at the ends of what validate() lets pass: finite radiance, no ray unresolved, bounded work.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "src/scene/validate.h"
#include "tests/support/surfaces.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::render;
using scene::Scene;

namespace {

constexpr int kSide = 12;

Scene small_scene(solid::Kind kind) {
    Scene scene = support::small_scene(kind, kSide, kSide);
    scene.sampling.N = 1;
    scene.surface.octaves = 6;
    scene.camera.far = 50.0;
    scene.sky.haze_distance = 40.0;
    return scene;
}

struct Extreme {
    std::string name;
    std::function<void(Scene&)> set;
};

struct Outcome {
    Counters counters;
    double seconds = 0.0;
    int rendered = 0, refused = 0, not_finite = 0, negative = 0;
};

void render_into(const Scene& scene, Outcome& outcome) {
    try {
        scene::validate(scene);
    } catch (const scene::SceneError&) {
        ++outcome.refused;
        return;
    }
    ++outcome.rendered;
    const auto image = make_image(scene);
    const Rect frame{0, 0, scene.film.width, scene.film.height};
    RenderOptions options;
    options.threads = 1;
    const RenderResult result = render::render(*image, Estimator(estimator_settings(scene)), frame, options);
    outcome.counters += result.counters;
    outcome.seconds += result.seconds;
    for (const glm::vec3& pixel : result.film.pixels()) {
        for (int c = 0; c < 3; ++c) {
            outcome.not_finite += !std::isfinite(pixel[c]);
            outcome.negative += pixel[c] < 0.0f;
        }
    }
}

void check(const Extreme& extreme) {
    for (const solid::Kind kind : support::all_kinds()) {
        Scene scene = small_scene(kind);
        extreme.set(scene);
        Outcome outcome;
        render_into(scene, outcome);
        CAPTURE(extreme.name);
        CAPTURE(static_cast<int>(kind));
        CHECK(outcome.not_finite == 0);
        CHECK(outcome.negative == 0);
        CHECK(outcome.counters.unresolved_rays == 0);
        const double rays = static_cast<double>(outcome.counters.rays + outcome.counters.shadow_rays);
        if (outcome.refused > 0) {
            MESSAGE(extreme.name << ", kind " << static_cast<int>(kind) << ": refused");
        } else if (static_cast<double>(outcome.counters.steps) > 300.0 * rays) {
            MESSAGE(extreme.name << ", kind " << static_cast<int>(kind) << ": "
                                 << static_cast<double>(outcome.counters.steps) / rays << " steps a ray, "
                                 << outcome.seconds << " s");
        }
        // A hundredth of what the step limit would allow: far from a hang.
        CHECK(static_cast<double>(outcome.counters.steps) <= 0.01 * trace::kStepLimit * rays);
    }
}

void look_from(Scene& scene, const glm::dvec3& position, const glm::dvec3& direction) {
    scene.camera.position = position;
    scene.camera.look_at = position + direction;
}

}  // namespace

TEST_CASE("noise at its extremes gives finite pictures or is refused") {
    const Extreme extremes[] = {
        {"32 octaves", [](Scene& s) { s.surface.octaves = 32; }},
        {"32 octaves, gain 1, lacunarity 1",
         [](Scene& s) {
             s.surface.octaves = 32, s.surface.gain = 1.0, s.surface.lacunarity = 1.0, s.surface.amplitude = 0.02;
         }},
        {"gain 0", [](Scene& s) { s.surface.gain = 0.0; }},
        {"gain 1", [](Scene& s) { s.surface.gain = 1.0, s.surface.amplitude = 0.1; }},
        {"lacunarity 1", [](Scene& s) { s.surface.lacunarity = 1.0; }},
        {"lacunarity 10", [](Scene& s) { s.surface.lacunarity = 10.0; }},
        {"lacunarity 10, gain 1", [](Scene& s) { s.surface.lacunarity = 10.0, s.surface.gain = 1.0; }},
        {"amplitude 0", [](Scene& s) { s.surface.amplitude = 0.0; }},
        {"amplitude 1e6", [](Scene& s) { s.surface.amplitude = 1e6; }},
        {"amplitude 1e6, frequency 1e9",
         [](Scene& s) { s.surface.amplitude = 1e6, s.surface.frequency = 1e9, s.surface.octaves = 3; }},
        {"amplitude 1e6, lacunarity 10, gain 1",
         [](Scene& s) {
             s.surface.amplitude = 1e6, s.surface.frequency = 1e9, s.surface.lacunarity = 10.0;
             s.surface.gain = 1.0, s.surface.octaves = 5;
         }},
        {"frequency 1e-9", [](Scene& s) { s.surface.frequency = 1e-9; }},
        {"frequency 1e9", [](Scene& s) { s.surface.frequency = 1e9, s.surface.octaves = 3; }},
        {"frequency 1e-9, amplitude 1e6", [](Scene& s) { s.surface.frequency = 1e-9, s.surface.amplitude = 1e6; }},
    };
    for (const Extreme& extreme : extremes) check(extreme);
}

TEST_CASE("cameras at their extremes give finite pictures") {
    const Extreme extremes[] = {
        {"inside the surface",
         [](Scene& s) {
             look_from(s, {0.1, -0.5, 0.2}, {0.3, 0.1, 1.0});
         }},
        {"at the origin",
         [](Scene& s) {
             look_from(s, {0, 0, 0}, {0.3, 0.1, 1.0});
         }},
        {"on the surface",
         [](Scene& s) {
             const trace::Field field(s.surface);
             glm::dvec3 outside{0.1, 2.9, 0.2}, inside{0.1, -0.9, 0.2};
             for (int i = 0; i < 80; ++i) {
                 const glm::dvec3 middle = 0.5 * (outside + inside);
                 (field.value(middle) > 0.0 ? outside : inside) = middle;
             }
             look_from(s, outside, {0.3, 0.1, 1.0});
         }},
        {"1e7 away",
         [](Scene& s) {
             look_from(s, {1e7, 2e6, -1e7}, {-1.0, -0.2, 1.0}), s.camera.far = 1e8;
         }},
        {"1e7 away through a telescope",
         [](Scene& s) {
             look_from(s, {1e7, 2e6, -1e7}, {-1.0, -0.2, 1.0});
             s.camera.far = 1e8, s.camera.fov_deg = 0.01;
         }},
        {"fov 0.01", [](Scene& s) { s.camera.fov_deg = 0.01; }},
        {"fov 179", [](Scene& s) { s.camera.fov_deg = 179.0; }},
        {"straight down",
         [](Scene& s) {
             look_from(s, {0.1, 5.0, 0.2}, {0.0, -1.0, 0.0});
         }},
        {"straight up",
         [](Scene& s) {
             look_from(s, {0.1, -5.0, 0.2}, {0.0, 1.0, 0.0});
         }},
        {"straight up from above",
         [](Scene& s) {
             look_from(s, {0.1, 5.0, 0.2}, {0.0, 1.0, 0.0});
         }},
        {"level at the height of the plane",
         [](Scene& s) {
             look_from(s, {0.1, 0.0, 0.2}, {0.0, 0.0, 1.0});
         }},
        {"one pixel", [](Scene& s) { s.film = {.width = 1, .height = 1}; }},
        {"tolerance 1e-12", [](Scene& s) { s.sampling.tolerance = 1e-12; }},
        {"far 1e12", [](Scene& s) { s.camera.far = 1e12, s.surface.octaves = 2, s.surface.frequency = 1e-3; }},
        {"far 1e-12", [](Scene& s) { s.camera.far = 1e-12; }},
    };
    for (const Extreme& extreme : extremes) check(extreme);
}

TEST_CASE("suns at their extremes give finite pictures") {
    const Extreme extremes[] = {
        {"straight above",
         [](Scene& s) {
             s.sun.direction = {0.0, 1.0, 0.0};
         }},
        {"level",
         [](Scene& s) {
             s.sun.direction = {1.0, 0.0, 0.0};
         }},
        {"below",
         [](Scene& s) {
             s.sun.direction = {0.0, -1.0, 0.0};
         }},
        {"a long vector",
         [](Scene& s) {
             s.sun.direction = {1e12, 1e12, 0.0};
         }},
        {"a short vector",
         [](Scene& s) {
             s.sun.direction = {1e-12, 1e-12, 0.0};
         }},
        {"bright", [](Scene& s) { s.sun.intensity = 1e6; }},
    };
    for (const Extreme& extreme : extremes) check(extreme);
}

TEST_CASE("a plane far away is hit where it should be: its haze and horizon are those of algebra") {
    // A level plane seen from 1e7 above: every pixel below the horizon hits, none above.
    Scene scene = small_scene(solid::kKind<solid::HeightField>);
    scene.surface.amplitude = 0.0;
    scene.camera.far = 1e12;
    look_from(scene, {0.0, 1e7, 0.0}, {0.0, 0.0, 1.0});
    Outcome outcome;
    render_into(scene, outcome);
    CHECK(outcome.rendered == 1);
    scene.sampling.estimator = scene::EstimatorKind::none;
    Outcome centres;
    render_into(scene, centres);
    CHECK(centres.counters.hits == kSide * kSide / 2);
}
