// [[ground]] in scene files: what is read, printed, set and refused.
#include <doctest/doctest.h>

#include <string>

#include "src/scene/ground_keys.h"
#include "src/scene/key_text.h"
#include "src/scene/override.h"
#include "src/scene/printer.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tests/scene/random_scene.h"

namespace {

using namespace strata::scene;

const std::string kTwoLayers = R"(image = "surface"
[[ground]]
name = "rock"
kind = "granite"
[[ground]]
name = "snow"
colour = [0.9, 0.9, 0.95]
height_from = 1.5
slope_to_deg = 40.0
)";

std::string ground_refusal(const std::string& text) {
    try {
        validate(read_scene(text, "file"), "");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "accepted";
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("layers are read in their order, with defaults") {
    const Scene scene = read_scene(kTwoLayers, "file");
    REQUIRE(scene.ground.size() == 2);
    CHECK(scene.ground[0].name == "rock");
    CHECK(scene.ground[0].kind == GroundKind::granite);
    CHECK(scene.ground[1].kind == GroundKind::own);
    CHECK(scene.ground[1].colour == glm::dvec3(0.9, 0.9, 0.95));
    CHECK(scene.ground[1].height.from == 1.5);
    CHECK(scene.ground[1].height.to == kEndOfHeights);
    CHECK(scene.ground[1].slope_deg.to == 40.0);
    CHECK_NOTHROW(validate(scene, ""));
}

TEST_CASE("a layer's keys are documented, have ranges that hold their defaults, and no name twice") {
    GroundLayer layer;
    layer.name = "any";
    std::vector<std::string> names;
    for (const Key& key : describe_ground_layer(layer).keys) {
        CAPTURE(key.name);
        CHECK(key.meaning.size() >= 8);
        if (key.name != "name") CHECK(!field_problem(key));
        CHECK(std::ranges::find(names, key.name) == names.end());
        names.push_back(key.name);
    }
}

TEST_CASE("a printed scene with random layers reads back as the same") {
    Random random(31);
    for (int i = 0; i < 50; ++i) {
        Scene scene;
        scene.ground.resize(2);
        for (std::size_t l = 0; l < 2; ++l) {
            for (const Key& key : describe_ground_layer(scene.ground[l]).keys) randomise(key, random);
            scene.ground[l].name = l == 0 ? "low" : "high";
        }
        // The first has no mask, and every range has an inside.
        scene.ground[1].height = {-1.0, 1.0, 0.1};
        scene.ground[1].slope_deg = {1.0, 80.0, 0.1};
        scene.ground[1].facing = {-0.5, 0.5, 0.1};
        scene.ground[1].patches = {-1.0, 1.0, 0.1};
        scene.ground[1].beds = {-1.0, 1.0, 0.1};
        const GroundLayer kept = scene.ground[0];
        scene.ground[0] = {.name = "low", .kind = kept.kind, .colour = kept.colour, .tone = kept.tone};
        const std::string text = print_scene(scene, PrintedKeys::all);
        CHECK(print_scene(read_scene(text, "printed"), PrintedKeys::all) == text);
    }
}

TEST_CASE("a layer's keys are set by its name") {
    Scene scene = read_scene(kTwoLayers, "file");
    apply_override(scene, "ground.snow.height_from=2", "");
    apply_override(scene, "ground.rock.kind=basalt", "");
    CHECK(scene.ground[1].height.from == 2.0);
    CHECK(scene.ground[0].kind == GroundKind::basalt);
    CHECK_THROWS_WITH_AS(apply_override(scene, "ground.snow.heigth_from=2", ""), doctest::Contains("did you mean"),
                         SceneError);
    CHECK_THROWS_AS(apply_override(scene, "ground.nothing.cover=1", ""), SceneError);
}

TEST_CASE("the palette's kinds are in the enumerators' order and plausible") {
    for (std::size_t i = 0; i < kGroundKinds; ++i) {
        const PaletteGround& ground = ground_palette()[i];
        CAPTURE(ground.name);
        CHECK(static_cast<std::size_t>(ground.kind) == i);
        CHECK(is_name(ground.name));
        for (int c = 0; c < 3; ++c) {
            CHECK(ground.albedo[c] >= (i == 0 ? 0.0 : 0.01));
            CHECK(ground.albedo[c] <= 0.96);
        }
    }
}

TEST_CASE("a ground that cannot be is refused with its place") {
    const std::string& good = kTwoLayers;
    const std::vector<std::pair<std::string, std::string>> cases{
        {changed(good, "name = \"rock\"\n", ""), "file:2:1: ground[0]: has no name"},
        {changed(good, "\"granite\"", "\"granit\""), "file:4:8: ground.rock.kind: unknown name (\"granit\")"},
        {changed(good, "0.95]", "1.95]"), "file:7:21: ground.snow.colour: out of range (1.95)"},
        {changed(good, "height_from", "height_form"), "file:8:1: ground.snow.height_form: unknown key"},
        {changed(good, "slope_to_deg = 40.0", "slope_to_deg = 200.0"), "file:9:16: ground.snow.slope_to_deg: out of"},
        {changed(good, "slope_to_deg = 40.0", "height_to = 1.5"),
         "file:8:15: ground.snow.height_from: not below height_to (1.5, 1.5)"},
        {changed(good, "name = \"snow\"", "name = \"rock\""), "file:6:8: ground[1].name: there already"},
        {changed(good, "name = \"snow\"", "name = \"a b\""), "file:6:8: ground[1].name: not a name"},
        {changed(good, "kind = \"granite\"", "cover = 0.5"),
         "file:4:9: ground.rock.cover: the first layer lies everywhere"},
        {changed(good, "slope_to_deg = 40.0",
                 "height_noise = 0.1\nnoise_size = 1e-6\nnoise_octaves = 16\n[camera]\nfar = 1e6"),
         "ground.snow: its finest noise has"},
        {"ground = 3\n", "file:1:10: ground: wrong type (3)"},
        {"[ground]\nname = \"snow\"\n", "file:1:1: ground: wrong type"},
    };
    for (const auto& [text, expected] : cases)
        CHECK_MESSAGE(ground_refusal(text).find(expected) != std::string::npos, ground_refusal(text), " not ",
                      expected);
    CHECK(ground_refusal(good) == "accepted");
}
