#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "src/strata.h"
#include "tests/image/scratch_folder.h"
#include "tests/library/errors.h"

using strata::Scene;

namespace {

strata::RenderReport render_tiny(Scene scene, const std::filesystem::path& file) {
    scene.set("film.width", 16);
    scene.set("film.height", 9);
    scene.set("sampling.N", 1);
    return strata::render_file(scene, file);
}

// A scene of defaults but for its relief: keys change the terms that are there, and TOML alone adds any.
Scene terms_of(const Scene& scene) {
    const std::string text = scene.toml();
    const std::size_t begin = text.find("[[relief]]");
    return begin == text.npos ? Scene() : Scene::parse(text.substr(begin));
}

}  // namespace

TEST_CASE("keys take numbers, words, truths and vectors, and give them back to the bit") {
    Scene scene;
    scene.set("camera.fov_deg", 35);
    CHECK(scene.get("camera.fov_deg") == "35.0");
    scene.set("camera.fov_deg", 0.1f + 0.2);
    CHECK(std::stod(scene.get("camera.fov_deg")) == 0.1f + 0.2);
    scene.set("sampling.estimator", "sobol");
    CHECK(scene.get("sampling.estimator") == "\"sobol\"");
    scene.set("sun.shadows", false);
    CHECK(scene.get("sun.shadows") == "false");
    scene.set("sun.shadows", "true");
    CHECK(scene.get("sun.shadows") == "true");
    scene.set("sampling.seed", std::numeric_limits<long long>::max());
    CHECK(scene.get("sampling.seed") == "9223372036854775807");
    scene.set("camera.position", {1.0, -2.5, 1.0 / 3.0});
    CHECK(scene.get("camera.position") == "[1.0, -2.5, 0.3333333333333333]");
    scene.set("title", "two words");
    CHECK(scene.get("title") == "\"two words\"");
}

TEST_CASE("every key takes its own value back, and the printed scene is the same scene") {
    for (const std::string& name : Scene::builtin_names()) {
        const Scene scene = Scene::builtin(name);
        Scene other = terms_of(scene);
        for (const strata::Key& key : scene.keys()) {
            other.set(key.name, key.value);
            CHECK(other.get(key.name) == key.value);
            CHECK(!key.allowed.empty());
            CHECK(!key.meaning.empty());
        }
        CHECK(other.toml() == scene.toml());
        CHECK(Scene::parse(scene.toml()).toml() == scene.toml());
        scene.check();
    }
}

TEST_CASE("a wrong key or value names the key and what is allowed, and changes nothing") {
    Scene scene = Scene::builtin("planet");
    const std::string before = scene.toml();
    check_says(message_of([&] { scene.set("camera.fov", 3); }), "did you mean 'camera.fov_deg'");
    check_says(message_of([&] { scene.get("camera.fov"); }), "did you mean 'camera.fov_deg'");
    check_says(message_of([&] { scene.set("camera.fov_deg", 400); }),
               "camera.fov_deg: out of range (400), allowed: 0.01 to 179 degrees");
    check_says(message_of([&] { scene.set("camera.fov_deg", std::nan("")); }), "camera.fov_deg: not a finite number");
    check_says(message_of([&] { scene.set("sampling.N", 2.5); }), "sampling.N: ");
    check_says(message_of([&] { scene.set("sampling.seed", -1); }), "sampling.seed: ");
    check_says(message_of([&] { scene.set("sampling.seed", ~0ull); }), "sampling.seed: ");
    check_says(message_of([&] { scene.set("sampling.estimator", "stratifed"); }), "did you mean 'stratified'");
    check_says(message_of([&] { scene.set("camera.position", {1.0, INFINITY, 0.0}); }), "camera.position");
    check_says(message_of([&] { scene.set("", 1); }), "unknown key");
    CHECK(scene.toml() == before);
}

TEST_CASE("what keys say together is refused before a ray is cast") {
    Scene scene;
    scene.set("surface.octaves", 32);
    scene.set("surface.lacunarity", 10.0);
    check_says(message_of([&] { scene.check(); }), "2^50");
    check_says(message_of([&] { strata::render_image(scene); }), "2^50");
    check_says(message_of([&] { strata::Probe probe(scene); }), "2^50");
}

TEST_CASE("texts and files that are no scene are refused with their place") {
    const ScratchFolder folder;
    check_says(message_of([] { Scene::parse("[camera]\nfov_deg = 400\n", "mine"); }), "mine:2:");
    check_says(message_of([] { Scene::builtin("planett"); }), "did you mean 'planet'?");
    check_says(message_of([&] { Scene::load(folder / "none.toml"); }), "none.toml: ");
    check_says(message_of([&] { Scene::load(folder.path()); }), folder.path().string());
    write_bytes(folder / "bad.toml", "[camera]\n\nfov_dg = 30\n");
    check_says(message_of([&] { Scene::load(folder / "bad.toml"); }), "bad.toml:3:1: ");
}

TEST_CASE("a picture gives its scene back, unless it is damaged") {
    const ScratchFolder folder;
    Scene scene = Scene::builtin("wheel");
    scene.set("wheel.spokes", 7);
    scene.set("film.width", 16);
    scene.set("film.height", 9);
    scene.set("sampling.N", 1);
    for (const char* name : {"a.exr", "a.png", "a.tif", "a.jpg"}) {
        render_tiny(scene, folder / name);
        CHECK(Scene::load(folder / name).toml() == scene.toml());
    }
    std::string bytes = file_bytes(folder / "a.png");
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    write_bytes(folder / "a.png", bytes);
    check_says(message_of([&] { Scene::load(folder / "a.png"); }), "a.png");
}

TEST_CASE("scenes are values: a copy's changes are its own") {
    Scene scene = Scene::builtin("edge");
    Scene copy = scene;
    copy.set("edge.angle_deg", 12);
    CHECK(scene.get("edge.angle_deg") != copy.get("edge.angle_deg"));
    scene = copy;
    CHECK(scene.toml() == copy.toml());
    const Scene moved = std::move(copy);
    CHECK(moved.toml() == scene.toml());
    CHECK(moved.width() == std::stoi(moved.get("film.width")));
    CHECK(moved.height() == std::stoi(moved.get("film.height")));
}
