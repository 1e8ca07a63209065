// [[clouds]] in scene files: what is read, printed, set and refused.
#include <doctest/doctest.h>

#include <string>

#include "src/scene/cloud_keys.h"
#include "src/scene/key_text.h"
#include "src/scene/needs.h"
#include "src/scene/override.h"
#include "src/scene/printer.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tests/scene/random_scene.h"
#include "tests/scene/refused_text.h"

namespace {

using namespace strata::scene;

const std::string kTwoClouds = R"([sky]
model = "daylight"
[[clouds]]
name = "cumulus"
coverage = 0.45
[[clouds]]
name = "cirrus"
altitude_m = 9000.0
stretch = 4.0
)";

}  // namespace

TEST_CASE("layers of clouds are read in their order, with defaults") {
    const Scene scene = read_scene(kTwoClouds, "file");
    REQUIRE(scene.clouds.size() == 2);
    CHECK(scene.clouds[0].name == "cumulus");
    CHECK(scene.clouds[0].coverage == 0.45);
    CHECK(scene.clouds[0].altitude_m == 2500.0);
    CHECK(scene.clouds[1].altitude_m == 9000.0);
    CHECK(scene.clouds[1].stretch == 4.0);
    CHECK_NOTHROW(validate(scene, ""));
    CHECK(needs_clouds(scene));
}

TEST_CASE("layers of no depth or no coverage are no clouds") {
    Scene scene = read_scene(kTwoClouds, "file");
    scene.clouds[0].coverage = 0.0;
    CHECK(needs_clouds(scene));
    scene.clouds[1].depth = 0.0;
    CHECK(!needs_clouds(scene));
    CHECK(!needs_clouds(Scene{}));
}

TEST_CASE("a wind moves the picture where its layer is there, and is refused where it carries the noise too far") {
    Scene scene = read_scene(kTwoClouds, "file");
    CHECK(!clouds_drift(scene));
    scene.clouds[1].wind_m_s = 30.0;
    scene.clouds[1].size_m = 10.0;
    scene.clouds[1].octaves = 16;
    CHECK(clouds_drift(scene));
    CHECK(motion(scene).any());
    CHECK_NOTHROW(validate(scene, ""));
    scene.shutter.frame = 1'000'000'000;
    scene.shutter.fps = 1e-3;
    CHECK_THROWS_WITH(validate(scene, ""), doctest::Contains("less wind, an earlier frame"));
    scene.clouds[1].depth = 0.0;
    CHECK(!clouds_drift(scene));
}

TEST_CASE("a cloud layer's keys are documented, have ranges that hold their defaults, and no name twice") {
    CloudLayer layer;
    layer.name = "any";
    std::vector<std::string> names;
    for (const Key& key : describe_cloud_layer(layer).keys) {
        CAPTURE(key.name);
        CHECK(key.meaning.size() >= 8);
        CHECK(!field_problem(key));
        CHECK(std::ranges::find(names, key.name) == names.end());
        names.push_back(key.name);
    }
}

TEST_CASE("a printed scene with random clouds reads back as the same") {
    Random random(32);
    for (int i = 0; i < 50; ++i) {
        Scene scene;
        scene.clouds.resize(2);
        for (std::size_t l = 0; l < 2; ++l) {
            for (const Key& key : describe_cloud_layer(scene.clouds[l]).keys) randomise(key, random);
            scene.clouds[l].name = l == 0 ? "low" : "high";
        }
        const std::string text = print_scene(scene, PrintedKeys::all);
        CHECK(print_scene(read_scene(text, "printed"), PrintedKeys::all) == text);
    }
}

TEST_CASE("a cloud layer's keys are set by its name") {
    Scene scene = read_scene(kTwoClouds, "file");
    apply_override(scene, "clouds.cirrus.depth=0.7", "");
    CHECK(scene.clouds[1].depth == 0.7);
    CHECK_THROWS_WITH_AS(apply_override(scene, "clouds.cirrus.dept=2", ""), doctest::Contains("did you mean"),
                         SceneError);
    CHECK_THROWS_AS(apply_override(scene, "clouds.nothing.depth=1", ""), SceneError);
}

TEST_CASE("clouds that cannot be are refused with their place") {
    const std::string& good = kTwoClouds;
    const std::vector<std::pair<std::string, std::string>> cases{
        {with(good, "name = \"cumulus\"\n", ""), "file:3:1: clouds[0]: has no name, allowed: name = \"cumulus\""},
        {with(good, "0.45", "1.45"), "file:5:12: clouds.cumulus.coverage: out of range (1.45)"},
        {with(good, "stretch", "strech"), "file:9:1: clouds.cirrus.strech: unknown key"},
        {with(good, "\"cirrus\"", "\"cumulus\""), "file:7:8: clouds[1].name: there already"},
        {with(good, "\"daylight\"", "\"gradient\""), "clouds.cumulus: lit by daylight alone"},
        {with(good, "stretch = 4.0", "size_m = 1.0\noctaves = 16\n[camera]\nfar = 1e12"),
         "clouds.cirrus: its finest noise has"},
        {"clouds = 3\n", "file:1:10: clouds: wrong type (3)"},
    };
    for (const auto& [text, expected] : cases)
        CHECK_MESSAGE(refusal(text).find(expected) != std::string::npos, refusal(text), " not ", expected);
    CHECK(refusal(good) == "accepted");
}
