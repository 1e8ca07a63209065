#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "src/scene/builtin.h"
#include "src/scene/printer.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"

using namespace strata;
using namespace strata::scene;

namespace {

Scene scene_named(const std::string& name) {
    const auto builtin = find_builtin(name);
    REQUIRE(builtin.has_value());
    return read_scene(builtin->text, name);
}

}  // namespace

TEST_CASE("every file of tools/scenes is built in, byte for byte, under its name") {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(STRATA_SOURCE_DIR "/tools/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        const std::string name = entry.path().stem();
        CAPTURE(name);
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        const auto builtin = find_builtin(name);
        REQUIRE(builtin.has_value());
        CHECK(builtin->text == text);
        names.insert(name);
    }
    std::set<std::string> built_in;
    for (const BuiltinScene& builtin : builtin_scenes()) built_in.insert(builtin.name);
    CHECK(built_in == names);
    for (const char* name : {"hills", "hyperterrain", "planet", "isosurface", "zoneplate", "checker", "wheel", "edge",
                             "ramp", "constant"}) {
        CHECK(names.count(name) == 1);
    }
}

TEST_CASE("every built-in scene is valid, titled on one line, and prints and reads back") {
    for (const BuiltinScene& builtin : builtin_scenes()) {
        CAPTURE(builtin.name);
        const Scene scene = read_scene(builtin.text, builtin.name);
        validate(scene, builtin.name);
        CHECK(builtin.title == scene.title);
        CHECK(builtin.title.size() >= 10);
        CHECK(builtin.title.size() <= 80);
        CHECK(builtin.title.find('\n') == std::string::npos);
        const std::string printed = print_scene(scene);
        CHECK(print_scene(read_scene(printed, "printed")) == printed);
        CHECK(printed.size() < 50'000);  // a JPEG of it has room for that
    }
}

TEST_CASE("the scenes of a kind of surface or picture are named after it") {
    CHECK(scene_named("terrain").surface.kind == solid::kKind<solid::HeightField>);
    CHECK(scene_named("planet").surface.kind == solid::kKind<solid::Sphere>);
    CHECK(scene_named("isosurface").surface.kind == solid::kKind<solid::LevelSet>);
    CHECK(scene_named("zoneplate").image == ImageKind::zoneplate);
    CHECK(scene_named("checker").image == ImageKind::checker);
    CHECK(scene_named("wheel").image == ImageKind::wheel);
    CHECK(scene_named("edge").image == ImageKind::edge);
    CHECK(scene_named("ramp").image == ImageKind::ramp);
    CHECK(scene_named("constant").image == ImageKind::constant);
}

TEST_CASE("the default scene is a still of at least 1280 by 720 by the default estimator") {
    const Scene scene = scene_named(std::string(kDefaultScene));
    CHECK(scene.film.width >= 1280);
    CHECK(scene.film.height >= 720);
    CHECK(scene.sampling.estimator == Sampling().estimator);
    CHECK(scene.sampling.estimator == EstimatorKind::shared_sobol);
    CHECK(scene.sampling.N >= 2);
    CHECK(scene.sampling.m == 4);
    CHECK(scene.shutter.open_s == 0.0);
}

TEST_CASE("the benchmark scene stays as it was fixed") {
    const Scene scene = scene_named("hyperterrain");
    CHECK(scene.surface.kind == solid::kKind<solid::DisplacedPlane>);
    CHECK(scene.surface.octaves == 8);
    CHECK(scene.surface.amplitude == 0.6);
    CHECK(scene.surface.frequency == 0.5);
    CHECK(scene.surface.gain == 0.5);
    CHECK(scene.surface.lacunarity == 2.0);
    CHECK(scene.surface.origin == glm::dvec3(0.0));
    CHECK(scene.surface.scale == 1.0);
    CHECK(scene.camera.position == glm::dvec3(0.3, 0.9, 0.1));
    CHECK(scene.camera.fov_deg == 50.0);
    CHECK(scene.camera.far == 60.0);
    CHECK(scene.film.width == 960);
    CHECK(scene.film.height == 540);
    const glm::dvec3 heading = glm::normalize(scene.camera.look_at - scene.camera.position);
    CHECK(heading.x == 0.0);
    CHECK(std::abs(std::asin(-heading.y) - 0.15) < 1e-15);
    CHECK(heading.z > 0.0);
}

TEST_CASE("terrain is another name of hills, and no scene of its own") {
    const auto hills = find_builtin("hills"), terrain = find_builtin("terrain");
    REQUIRE(hills.has_value());
    REQUIRE(terrain.has_value());
    CHECK(terrain->text.data() == hills->text.data());
    CHECK(terrain->name == "terrain");  // outputs are named as the scene was typed
    for (const BuiltinScene& builtin : builtin_scenes()) CHECK(builtin.name != "terrain");
}

TEST_CASE("a name that is not built in is not found") {
    CHECK(!find_builtin("hils"));
    CHECK(!find_builtin(""));
    CHECK(!find_builtin("terrain.toml"));
}
