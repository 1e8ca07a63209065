#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/scene_text.h"
#include "src/scene/toml_reader.h"

using namespace strata;
using namespace strata::scene;
using namespace std::string_literals;

namespace {

std::string error_of(const std::string& text) {
    try {
        read_scene(text, "t.toml");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

std::string load_error_of(const std::string& path) {
    try {
        load_scene(path);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

const std::string kCameraKeys = "position, look_at, up, fov_deg, far, interpolation, keys";
const std::string kSections =
    "film, sampling, shutter, camera, surface, scale, sun, sky, fog, water, material, zoneplate, checker, wheel, edge, "
    "ramp, constant";

}  // namespace

TEST_CASE("a file sets what it names and leaves the rest at the defaults") {
    const Scene scene = read_scene(
        "title = \"caf\u00e9\"\nimage = 'surface'\n[camera]\nfov_deg = 35\nposition = [1, -2.5, 3e2]\n"
        "[surface]\nkind = \"planet\"\nseed = 0xff\n[sun]\nshadows = false\n[sampling]\nestimator = "
        "\"shared-sobol\"\nN = 1_0\n",
        "t.toml");
    CHECK(scene.title == "caf\u00e9");
    CHECK(scene.camera.fov_deg == 35.0);
    CHECK(scene.camera.position == glm::dvec3(1.0, -2.5, 300.0));
    CHECK(scene.camera.far == Camera{}.far);
    CHECK(scene.surface.kind == solid::kKind<solid::Sphere>);
    CHECK(scene.surface.seed == 255);
    CHECK(scene.surface.octaves == Surface{}.octaves);
    CHECK(!scene.sun.shadows);
    CHECK(scene.sampling.estimator == EstimatorKind::shared_sobol);
    CHECK(scene.sampling.N == 10);
}

TEST_CASE("dotted keys, inline tables, Windows line ends and a byte order mark are read like the plain form") {
    for (const char* text : {"camera.fov_deg = 35\n", "camera = { fov_deg = 35.0 }", "[camera]\r\nfov_deg = 35\r\n",
                             "\xEF\xBB\xBF[camera]\nfov_deg = 35", "[wheel]\n[camera]\n\t\"fov_deg\"=35 # wide"}) {
        CAPTURE(text);
        CHECK(read_scene(text, "t.toml").camera.fov_deg == 35.0);
    }
}

TEST_CASE("keys of other kinds of picture are read as well") {
    CHECK(read_scene("image = \"surface\"\n[wheel]\nspokes = 5\n", "t.toml").wheel.spokes == 5);
}

TEST_CASE("unknown keys and sections are refused where they stand, with what is known and what was meant") {
    CHECK(error_of("[camera]\n  fov_dge = 35\n") == "t.toml:2:3: camera.fov_dge: unknown key, allowed in [camera]: " +
                                                        kCameraKeys + ", did you mean 'camera.fov_deg'?");
    CHECK(error_of("camera.fov = 35") == "t.toml:1:8: camera.fov: unknown key, allowed in [camera]: " + kCameraKeys +
                                             ", did you mean 'camera.fov_deg'?");
    CHECK(error_of("\n\nfov_deg = 35\n") ==
          "t.toml:3:1: fov_deg: unknown key, allowed outside sections: title, image; sections: " + kSections +
              ", did you mean 'camera.fov_deg'?");
    CHECK(error_of("[film]\nwidth = 3\nfov_deg = 35\n") ==
          "t.toml:3:1: film.fov_deg: unknown key, allowed in [film]: width, height, exposure, metered, tone, "
          "white_balance, saturation, contrast, did you mean 'camera.fov_deg'?");
    CHECK(error_of("[camera.lens]\nblades = 7\n") ==
          "t.toml:1:9: camera.lens: unknown key, allowed in [camera]: " + kCameraKeys);
    CHECK(error_of("[camrea]\nfov_deg = 35\n") ==
          "t.toml:1:2: camrea: unknown section, allowed: " + kSections + ", did you mean 'camera'?");
    CHECK(error_of("title = \"x\"\n [ smoke ]\n") == "t.toml:2:4: smoke: unknown section, allowed: " + kSections);
    CHECK(error_of("[\"\"]\nx = 1").starts_with("t.toml:1:2: \"\": unknown section"));
    CHECK(error_of("\"\" = 1").starts_with("t.toml:1:1: \"\": unknown key"));
    CHECK(error_of("\"a\\nb\" = 1").starts_with("t.toml:1:1: a\\u000Ab: unknown key"));
}

TEST_CASE("columns count characters, not bytes") {
    CHECK(error_of("[film]\n\"\u2603\u2603\" = 3").starts_with("t.toml:2:1: film.\u2603\u2603: unknown key"));
    CHECK(error_of("camera = { \"\u2603\" = 3, fov_deg = 900 }").starts_with("t.toml:1:12: camera.\u2603: unknown"));
    CHECK(error_of("# \u2603 \x01").starts_with("t.toml:1:5: not text (byte 0x01)"));
}

TEST_CASE("a section that is no section and a key that is one are wrong types") {
    CHECK(error_of("camera = 3\n") == "t.toml:1:1: camera: wrong type (3), allowed: one section [camera] of keys");
    CHECK(error_of("[[camera]]\nfov_deg = 35\n") ==
          "t.toml:1:3: camera: wrong type (an array of 1), allowed: one section [camera] of keys");
    CHECK(error_of("[image]\nx = 3\n").starts_with("t.toml:1:1: image: wrong type (a table), allowed: \"surface\""));
    CHECK(error_of("[film]\nwidth.pixels = 3\n").find("film.width: wrong type (a table)") != std::string::npos);
}

TEST_CASE("of several errors the first in the file is named") {
    CHECK(error_of("[wheel]\nspokes = 0\n[camera]\nfov_deg = 900\n").starts_with("t.toml:2:10: wheel.spokes: out of"));
    CHECK(error_of("[surface]\noctaves = 99\namplitude = -1\n").starts_with("t.toml:2:11: surface.octaves: out of"));
    CHECK(error_of("[smoke]\n[camera]\nfov_deg = 900\n").starts_with("t.toml:1:2: smoke: unknown section"));
    CHECK(error_of("[camera]\nfov_deg = 900\n[fog]\n").starts_with("t.toml:2:11: camera.fov_deg: out of range (900)"));
}

TEST_CASE("bad syntax is refused with its line and column") {
    CHECK(error_of("x = \n").starts_with("t.toml:1:5: syntax: "));
    CHECK(error_of("[film]\nwidth = wide\n").starts_with("t.toml:2:9: syntax: "));
    CHECK(error_of("[film\nwidth = 3\n").starts_with("t.toml:1:6: syntax: "));
    CHECK(error_of("[film]\nwidth 3\n").starts_with("t.toml:2:7: syntax: "));
    CHECK(error_of("title = \"abc").starts_with("t.toml:1:13: syntax: "));
    CHECK(error_of("[camera]\nposition = [1,\n2").starts_with("t.toml:3:2: syntax: "));
    CHECK(error_of("[film]\nwidth = 99999999999999999999\n").starts_with("t.toml:2:29: syntax: "));
}

TEST_CASE("a key or section given twice is refused where it stands the second time") {
    const std::string twice = error_of("[camera]\nfov_deg = 35\nfov_deg = 36\n");
    CHECK(twice.starts_with("t.toml:3:"));
    CHECK(twice.find("fov_deg") != std::string::npos);
    CHECK(error_of("[camera]\nfov_deg = 35\n[film]\n[camera]\nfar = 3\n").starts_with("t.toml:4:"));
}

TEST_CASE("text without a key is refused and says what a scene file holds") {
    for (const char* text : {"", "\n\n", "# only a comment\n", "[camera]\n", "\xEF\xBB\xBF", " \t\r\n"}) {
        CAPTURE(text);
        const std::string error = error_of(text);
        CHECK(error.starts_with("t.toml:1:1: empty, allowed: a scene file holds at least one key"));
        CHECK(error.find("strata scenes hills") != std::string::npos);
    }
}

TEST_CASE("binary junk is refused at the first byte that no text holds") {
    CHECK(error_of("a = 1\nb\0"s).starts_with("t.toml:2:2: not text (byte 0x00), allowed: a scene file in TOML"));
    CHECK(error_of("\x7f"
                   "ELF\x02\x01")
              .starts_with("t.toml:1:1: not text (byte 0x7f)"));
    CHECK(error_of("\x89PNG\r\n\x1a\n").starts_with("t.toml:2:1: not text (byte 0x1a)"));
    CHECK(error_of("\xff\xd8\xff\xe0").starts_with("t.toml:1:1: syntax: "));
    CHECK(error_of("v/1\x01").starts_with("t.toml:1:4: not text (byte 0x01)"));
}

TEST_CASE("huge and deeply nested files are refused before they exhaust memory or stack") {
    CHECK(error_of(std::string(kLargestFile + 1, ' ')).starts_with("t.toml:1:1: too large, allowed: "));
    std::string deep = "a";
    for (int i = 0; i < 300000; ++i) deep += ".a";
    CHECK(error_of(deep + " = 1").starts_with("t.toml:1:1: too many full stops (300000), allowed: 4000"));
    CHECK(error_of(deep.substr(0, 2 * static_cast<std::size_t>(kMostDots) + 1) + " = 1")
              .starts_with("t.toml:1:1: a: unknown section"));
    CHECK(error_of("x = " + std::string(100000, '[')).starts_with("t.toml:1:"));
    CHECK(error_of("x = " + std::string(200000, '{')).starts_with("t.toml:1:"));
}

TEST_CASE("messages stay on one short line whatever the file holds") {
    const std::string longest(50000, 'k');
    const std::vector<std::string> texts{longest + " = 1",
                                         "[" + longest + "]",
                                         "[camera]\n" + longest + " = 1",
                                         "image = \"" + longest + "\"",
                                         "[camera]\nfov_deg = \"\"\"a\nb\"\"\"",
                                         "[camera]\n\"x\\ny\" = 1",
                                         "[camera]\nfov_deg = \"\\u0007\""};
    for (const std::string& text : texts) {
        const std::string error = error_of(text);
        CAPTURE(error);
        CHECK(!error.empty());
        CHECK(error.size() < 500);
        CHECK(error.find('\n') == std::string::npos);
        CHECK(error.find('\a') == std::string::npos);
    }
}

TEST_CASE("files are loaded by path, and what is no file is refused by name") {
    const std::string folder =
        std::filesystem::temp_directory_path() / fmt::format("strata_scene_{}", std::random_device{}());
    std::filesystem::create_directory(folder);
    const std::string path = folder + "/hills.toml";
    std::ofstream(path) << "[camera]\nfov_deg = 35\n";
    CHECK(load_scene(path).camera.fov_deg == 35.0);

    std::ofstream(path) << "[camera]\nfov_deg = 350\n";
    CHECK(load_error_of(path) == path + ":2:11: camera.fov_deg: out of range (350), allowed: 0.01 to 179 degrees");
    std::ofstream(path, std::ios::trunc).close();
    CHECK(load_error_of(path).starts_with(path + ":1:1: empty"));
    CHECK(load_error_of(folder) == folder + ": a folder, allowed: a scene file in TOML");
    CHECK(load_error_of(folder + "/missing.toml") == folder + "/missing.toml: no such file");
    CHECK(load_error_of("") == ": no such file");
    CHECK(load_error_of("/dev/zero").starts_with("/dev/zero:1:1: too large"));
    std::filesystem::remove_all(folder);
}
