#include "src/scene/needs.h"

#include <doctest/doctest.h>

#include <random>

#include "src/scene/camera_path.h"

using namespace strata;
using namespace strata::scene;

namespace {

Scene open_scene() {
    Scene scene;
    scene.shutter = {.fps = 25.0, .open_s = 0.02, .frame = 10};  // [0.4, 0.42] s
    return scene;
}

CameraKey key(double time_s, double x) { return {.time_s = time_s, .position = glm::dvec3(x, 1.0, 0.0)}; }

}  // namespace

TEST_CASE("a scene at rest needs no time samples, however long its shutter is open") {
    Scene scene = open_scene();
    CHECK(!motion(scene).any());
    CHECK(!needs_time_samples(scene));
    for (const ImageKind image : {ImageKind::zoneplate, ImageKind::checker}) {
        scene.image = image;
        scene.surface.spin_deg_per_s = 90.0;  // of a surface that is not in the picture
        CHECK(!needs_time_samples(scene));
    }
    scene.image = ImageKind::wheel;
    CHECK(needs_time_samples(scene));
    scene.wheel.turns_per_s = 0.0;
    CHECK(!needs_time_samples(scene));
}

TEST_CASE("each kind of motion needs time samples, unless the shutter or the estimator knows one instant alone") {
    for (int what = 0; what < 3; ++what) {
        Scene scene = open_scene();
        if (what == 0) scene.surface.spin_deg_per_s = -1e-3;
        if (what == 1) scene.surface.drift = {0.0, 0.0, 1e-9};
        if (what == 2) scene.camera.keys = {key(0.0, 0.0), key(1.0, 1.0)};
        CHECK(motion(scene).spin == (what == 0));
        CHECK(motion(scene).drift == (what == 1));
        CHECK(motion(scene).camera == (what == 2));
        CHECK(needs_time_samples(scene));
        Scene instant = scene;
        instant.shutter.open_s = 0.0;
        CHECK(!needs_time_samples(instant));
        scene.sampling.estimator = EstimatorKind::none;
        CHECK(!needs_time_samples(scene));
    }
}

TEST_CASE("a drift counts where the noise depends on it") {
    Surface surface;
    surface.drift = {0.0, 1.0, 0.0};
    for (const solid::Kind kind :
         {solid::kKind<solid::DisplacedPlane>, solid::kKind<solid::Sphere>, solid::kKind<solid::LevelSet>}) {
        surface.kind = kind;
        CHECK(noise_drifts(surface));
    }
    surface.kind = solid::kKind<solid::HeightField>;
    CHECK(!noise_drifts(surface));
    surface.drift.x = 1e-300;
    CHECK(noise_drifts(surface));
    surface.amplitude = 0.0;
    CHECK(!noise_drifts(surface));
}

TEST_CASE("a camera rests exactly where its position does not change while the shutter is open") {
    std::mt19937_64 random(7);
    int resting = 0, moving = 0;
    for (int trial = 0; trial < 400; ++trial) {
        Scene scene = open_scene();
        scene.camera.interpolation = trial % 2 == 0 ? Interpolation::smooth : Interpolation::linear;
        double time = -0.2037, x = 0.0;
        for (int k = 0; k < 6; ++k) {
            time += 0.05 + 0.01 * static_cast<double>(random() % 30);
            if (random() % 2 == 0) x += 1.0 + static_cast<double>(random() % 3);
            scene.camera.keys.push_back(key(time, x));
        }
        scene.shutter.frame = static_cast<int>(random() % 40);
        scene.sampling.time_order = 1 + static_cast<int>(random() % 4);
        const TimeSpan open = open_shutter(scene);
        const CameraPath path(scene.camera);
        double least = 1e9, most = -1e9;
        for (int i = 0; i <= 400; ++i) {
            const double at = path.at(open.first + (open.last - open.first) * i / 400.0).position.x;
            least = std::min(least, at);
            most = std::max(most, at);
        }
        CHECK(motion(scene).camera == (most - least > 1e-12));
        (motion(scene).camera ? moving : resting) += 1;
    }
    CHECK(resting > 50);
    CHECK(moving > 50);
}

TEST_CASE("shadows need a sun that shines and casts them") {
    Scene scene;
    Sun& sun = scene.sun;
    CHECK(needs_shadow_rays(scene));
    sun.colour = {0.0, 0.0, 1e-9};
    CHECK(needs_shadow_rays(scene));
    sun.colour = glm::dvec3(0.0);
    CHECK(!needs_shadow_rays(scene));
    sun = {};
    sun.intensity = 0.0;
    CHECK(!needs_shadow_rays(scene));
    sun = {};
    sun.shadows = false;
    CHECK(!needs_shadow_rays(scene));
    scene.sky.model = SkyModel::daylight;
    CHECK(!needs_shadow_rays(scene));
    sun = {.colour = glm::dvec3(0.0), .intensity = 0.0};
    CHECK(needs_shadow_rays(scene));  // daylight's sun has its own light
}
