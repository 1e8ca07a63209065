#include <doctest/doctest.h>

#include <string>

#include "src/scene/override.h"
#include "src/scene/printer.h"
#include "src/scene/relief_keys.h"

using namespace strata::scene;

namespace {

Scene with(const std::string& assignment) {
    Scene scene;
    apply_override(scene, assignment);
    return scene;
}

std::string error_of(const std::string& assignment, const std::string& option = "") {
    Scene scene;
    try {
        apply_override(scene, assignment, option);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

const std::string kSections =
    "film, sampling, shutter, camera, surface, scale, sun, sky, fog, water, material, zoneplate, checker, wheel, "
    "edge, ramp, constant";

}  // namespace

TEST_CASE("an override takes any TOML value, and plain words as strings") {
    CHECK(with("camera.fov_deg=35").camera.fov_deg == 35.0);
    CHECK(with(" camera.fov_deg = 3.5e1 ").camera.fov_deg == 35.0);
    CHECK(with("camera.position=[1, 2.5,-3]").camera.position == glm::dvec3(1.0, 2.5, -3.0));
    CHECK(with("sampling.estimator=shared-sobol").sampling.estimator == EstimatorKind::shared_sobol);
    CHECK(with("sampling.estimator=\"sobol\"").sampling.estimator == EstimatorKind::sobol);
    CHECK(with("image=wheel").image == ImageKind::wheel);
    CHECK(with("sun.shadows=false").sun.shadows == false);
    CHECK(with("surface.seed=9223372036854775807").surface.seed == 0x7fff'ffff'ffff'ffffu);
    CHECK(with("title=Hills at noon v1.2").title == "Hills at noon v1.2");
    CHECK(with("title=\"a = b\"").title == "a = b");
    CHECK(with("title='inf'").title == "inf");
    CHECK(with("title=\"\"\"two\nlines\"\"\"").title == "two\nlines");
}

TEST_CASE("text without quotes is a string, whatever it holds, where the key takes text") {
    for (const char* text : {"Größe", "山", "2001", "true", "1979-05-27", "[a]", "semi;colon", "a = b", "Tom's hill",
                             "5 % \"steep\"", "back\\slash", ".5", "#1"}) {
        CAPTURE(text);
        CHECK(with(std::string("title=") + text).title == text);
    }
}

TEST_CASE("numbers are read as people type them, in vectors too") {
    CHECK(with("camera.fov_deg=.5").camera.fov_deg == 0.5);
    CHECK(with("camera.fov_deg=5.").camera.fov_deg == 5.0);
    CHECK(with("camera.fov_deg=+1").camera.fov_deg == 1.0);
    CHECK(with("camera.fov_deg=+.25e1").camera.fov_deg == 2.5);
    CHECK(with("camera.far=1e3").camera.far == 1000.0);
    CHECK(with("camera.far=1.e3").camera.far == 1000.0);
    CHECK(with("camera.position=[.5, -1., +2e-1]").camera.position == glm::dvec3(0.5, -1.0, 0.2));
    CHECK(with("sampling.N=+4").sampling.N == 4);
    CHECK(with("sampling.N=1e1").sampling.N == 10);
    CHECK(with("sampling.N=4.").sampling.N == 4);
    CHECK(with("film.width=1.28e3").film.width == 1280);
    CHECK(with("surface.seed=1e3").surface.seed == 1000);
    CHECK(error_of("camera.fov_deg=.").find("not a value (.)") != std::string::npos);
    CHECK(error_of("camera.fov_deg=0,5").find("not a value (0,5)") != std::string::npos);
    CHECK(error_of("camera.fov_deg=1e999") != "");
}

TEST_CASE("an override changes that key alone") {
    const Scene scene = with("surface.seed=7");
    CHECK(scene.surface.seed == 7);
    CHECK(scene.sampling.seed == Scene{}.sampling.seed);
}

TEST_CASE("an override that is none is refused with the option, the key and what was meant") {
    CHECK(error_of("camera.fov=35") ==
          "--set camera.fov=35: camera.fov: unknown key, allowed in [camera]: position, look_at, up, fov_deg, far, "
          "interpolation, keys, did you mean 'camera.fov_deg'?");
    CHECK(error_of("camrea.fov_deg=35") ==
          "--set camrea.fov_deg=35: camrea.fov_deg: unknown key, allowed outside sections: title, image; sections: " +
              kSections + ", did you mean 'camera.fov_deg'?");
    CHECK(error_of("fov_deg=35") ==
          "--set fov_deg=35: fov_deg: unknown key, allowed outside sections: title, image; sections: " + kSections +
              ", did you mean 'camera.fov_deg'?");
    CHECK(error_of("camera.fov_deg=350") ==
          "--set camera.fov_deg=350: camera.fov_deg: out of range (350), allowed: 0.01 to 179 degrees");
    CHECK(error_of("camera.fov_deg=wide") ==
          "--set camera.fov_deg=wide: camera.fov_deg: wrong type, a string (\"wide\"), allowed: 0.01 to 179 degrees");
    CHECK(error_of("sampling.estimator=sobl").ends_with("did you mean 'sobol'?"));
    CHECK(
        error_of("sampling.N=4.5", "-N 4.5") ==
        "-N 4.5: sampling.N: must be an integer, written without a point or exponent (4.5), allowed: integers 1 to 64");
}

TEST_CASE("what has no key, no value or more than one value is refused") {
    CHECK(error_of("camera.fov_deg") ==
          "--set camera.fov_deg: no '=', allowed: section.key=value, such as camera.fov_deg=35");
    CHECK(error_of("").starts_with("--set : no '='"));
    CHECK(error_of("=3").starts_with("--set =3: \"\": unknown key"));
    CHECK(error_of("camera.=3").starts_with("--set camera.=3: camera.\"\": unknown key"));
    CHECK(error_of("camera.fov_deg=") ==
          "--set camera.fov_deg=: camera.fov_deg: not a value (nothing), allowed: 0.01 to 179 degrees");
    CHECK(error_of("camera.fov_deg=35 36").find("camera.fov_deg: not a value (35 36)") != std::string::npos);
    CHECK(error_of("camera.fov_deg=35\ncamera.far=3").find("not a value (35\\u000Acamera.far=3)") != std::string::npos);
    CHECK(error_of("camera.position=[1,2").find("not a value ([1,2)") != std::string::npos);
    CHECK(error_of("title=\"half quoted").find("not a value (\"half quoted)") != std::string::npos);
    CHECK(error_of("title=two\nlines").find("not a value (two\\u000Alines)") != std::string::npos);
    CHECK(error_of("title=broken \xff UTF-8").find("not a value") != std::string::npos);
}

TEST_CASE("relief.seed moves the seeds of all terms, so that equal ones stay equal") {
    Scene scene;
    scene.surface.relief = {default_relief_term(0), default_relief_term(0), default_relief_term(0)};
    for (int i = 0; i < 3; ++i) {
        scene.surface.relief[static_cast<std::size_t>(i)].name = std::string(1, static_cast<char>('a' + i));
        apply_override(scene, std::string("relief.") + static_cast<char>('a' + i) + (i == 2 ? ".seed=9" : ".seed=4"));
    }
    Scene moved = scene, one_by_one = scene;
    apply_override(moved, "relief.seed=3");
    for (const char* assignment : {"relief.a.seed=7", "relief.b.seed=7", "relief.c.seed=12"})
        apply_override(one_by_one, assignment);
    CHECK(print_scene(moved) == print_scene(one_by_one));
    CHECK(print_scene(moved) != print_scene(scene));
    apply_override(scene, "relief.c.seed=9223372036854775807");
    CHECK_THROWS_WITH_AS(apply_override(scene, "relief.seed=1"), doctest::Contains("relief.seed: out of range"),
                         SceneError);
    CHECK_THROWS_WITH_AS(apply_override(scene, "relief.seed=-1"), doctest::Contains("relief.seed"), SceneError);
    CHECK(error_of("relief.seed=1").find("the scene has no [[relief]]") != std::string::npos);
}
