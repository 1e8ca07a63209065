#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "src/scene/validate.h"
#include "tests/scene/random_scene.h"

using namespace strata;
using namespace strata::scene;

namespace {

std::string error_of(const Scene& scene) {
    try {
        validate(scene, "t.toml");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

// The first octave, from 0, whose cells within reach exceed 2^50, in long double and from powers; -1: none.
int first_too_fine(const Surface& surface, double farthest) {
    for (int k = 0; k < surface.octaves; ++k) {
        const long double amplitude = surface.amplitude * std::pow(static_cast<long double>(surface.gain), k);
        const long double frequency = surface.frequency * std::pow(static_cast<long double>(surface.lacunarity), k);
        if (amplitude != 0 && frequency * farthest > 0x1p50L) return k;
    }
    return -1;
}

}  // namespace

TEST_CASE("the default scene is valid") { CHECK(error_of(Scene{}) == ""); }

TEST_CASE("an eye that looks at itself is refused where there is an eye") {
    Scene scene;
    scene.camera.look_at = scene.camera.position;
    CHECK(error_of(scene) ==
          "t.toml: camera.look_at: is the same point as camera.position ([0.0, 1.0, 0.0]), allowed: any other point");
    scene.image = ImageKind::zoneplate;
    CHECK(error_of(scene) == "");
}

TEST_CASE("looking along the up direction is allowed") {
    Scene scene;
    for (const double height : {-5.0, 5.0}) {
        scene.camera.look_at = scene.camera.position + glm::dvec3(0.0, height, 0.0);
        CHECK(error_of(scene) == "");
    }
}

TEST_CASE("an octave past 2^50 cells within reach is refused by number, with what to lower") {
    Scene scene;
    scene.surface.octaves = 32;
    scene.surface.lacunarity = 10.0;
    scene.surface.frequency = 0.5;
    scene.camera.far = 999.0;  // reach 1000: octave k + 1 has 500 * 10^k cells, 5e15 > 2^50 at k = 13
    CHECK(
        error_of(scene) ==
        "t.toml: surface.octaves: octave 14 of 32 is too fine for double precision (5e+12 lattice cells a surface "
        "unit, seen up to 1e+03 surface units from surface.origin, exceed 2^50 cells), allowed: surface.octaves up to "
        "13, or a lower surface.lacunarity, surface.frequency or camera.far, or a camera nearer to surface.origin");
    scene.surface.octaves = 13;
    CHECK(error_of(scene) == "");
    scene.surface.octaves = 1;
    scene.surface.frequency = 1e9;
    scene.camera.far = 1e12;
    CHECK(error_of(scene).find("octave 1 of 1 is too fine") != std::string::npos);
}

TEST_CASE("octaves of amplitude zero are never too fine") {
    Scene scene;
    scene.surface.octaves = 32;
    scene.surface.lacunarity = 10.0;
    scene.surface.gain = 0.0;
    CHECK(error_of(scene) == "");
    scene.surface.gain = 1.0;
    CHECK(error_of(scene) != "");
    scene.surface.amplitude = 0.0;
    CHECK(error_of(scene) == "");
}

TEST_CASE("reach is what the camera's rays see, in surface units") {
    Scene scene;
    scene.camera.position = {3.0, 0.0, 4.0};
    scene.camera.far = 10.0;
    CHECK(reach(scene) == doctest::Approx(15.0));
    scene.surface.origin = {3.0, 0.0, 0.0};
    scene.surface.scale = 0.5;
    CHECK(reach(scene) == doctest::Approx(28.0));
    scene.surface.kind = solid::kKind<solid::Sphere>;
    scene.surface.shape<solid::Sphere>().radius = 7.0;
    CHECK(reach(scene) == doctest::Approx(35.0));
    scene.surface.kind = solid::kKind<solid::LevelSet>;
    scene.surface.shape<solid::LevelSet>().bound_size = {2.0, 3.0, 6.0};
    CHECK(reach(scene) == doctest::Approx(2.0));
    scene.surface.shape<solid::LevelSet>().bound = solid::LevelSet::Bound::box;
    CHECK(reach(scene) == doctest::Approx(7.0));
}

TEST_CASE("a camera far away is valid, and an isosurface does not mind how far") {
    Scene scene;
    scene.camera.position = {1e7, 1.0, 0.0};
    scene.camera.far = 2e7;
    CHECK(error_of(scene) == "");
    scene.surface.octaves = 32;
    CHECK(error_of(scene) != "");
    scene.surface.kind = solid::kKind<solid::LevelSet>;
    CHECK(error_of(scene) == "");
}

TEST_CASE("random scenes are refused exactly when an octave is too fine") {
    Random random(5);
    int refused = 0;
    int accepted = 0;
    for (int i = 0; i < 5000; ++i) {
        Scene scene;
        Surface& surface = scene.surface;
        surface.octaves = 1 + static_cast<int>(random() % 32);
        surface.lacunarity = random_number({1.0, 10.0}, random);
        surface.gain = random() % 8 == 0 ? 0.0 : random_number({0.1, 1.0}, random);
        surface.frequency = std::pow(10.0, random_number({-9.0, 9.0}, random));
        scene.camera.far = std::pow(10.0, random_number({-9.0, 9.0}, random));
        const int octave = first_too_fine(surface, reach(scene));
        const std::string error = error_of(scene);
        CAPTURE(error);
        CAPTURE(octave);
        ++(octave < 0 ? accepted : refused);
        if (octave < 0) {
            CHECK(error == "");
        } else {
            CHECK(error.find(fmt::format("octave {} of {} ", octave + 1, surface.octaves)) != std::string::npos);
        }
    }
    MESSAGE("accepted " << accepted << ", refused " << refused);
    CHECK(accepted > 500);
    CHECK(refused > 500);
}
