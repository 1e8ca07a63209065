// [[relief]] in scene files: what is read, printed, set and refused.
#include <doctest/doctest.h>

#include <string>

#include "src/scene/override.h"
#include "src/scene/printer.h"
#include "src/scene/relief_keys.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tests/scene/refused_text.h"

namespace {

using namespace strata::scene;

const std::string kTwo = R"(image = "surface"
[[relief]]
name = "crests"
type = "ridged"
octaves = 5
feedback = 1.25
[[relief]]
name = "bent"
type = "warp"
of = ["crests"]
amplitude = 0.5
)";

}  // namespace

TEST_CASE("terms are read in their order, with the defaults of their types") {
    const Scene scene = read_scene(kTwo, "file");
    REQUIRE(scene.surface.relief.size() == 2);
    CHECK(scene.surface.relief[0].name == "crests");
    const auto& ridged = std::get<strata::noise::Ridged>(scene.surface.relief[0].node);
    CHECK(ridged.parameters.octaves == 5);
    CHECK(ridged.feedback == 1.25);
    CHECK(ridged.roundness == strata::noise::Ridged{}.roundness);
    CHECK(scene.surface.relief[1].of == std::vector<std::string>{"crests"});
    CHECK(std::get<strata::noise::Warp>(scene.surface.relief[1].node).parameters.amplitude == 0.5);
    CHECK_NOTHROW(validate(scene, ""));
}

TEST_CASE("a printed scene with a relief of every type reads back as the same") {
    Scene scene;
    for (std::size_t type = 0; type < relief_types().size(); ++type) {
        auto term = default_relief_term(type);
        term.name = std::string("t").append(std::to_string(type));  // of "t" + ..., g++ 12 warns without cause
        const int inputs = std::visit([](const auto& node) { return node.kFewestInputs; }, term.node);
        for (int i = 0; i < inputs; ++i) term.of.push_back("t0");
        scene.surface.relief.push_back(term);
    }
    CHECK_NOTHROW(validate(scene, ""));
    const std::string text = print_scene(scene, PrintedKeys::all);
    CHECK(print_scene(read_scene(text, "printed"), PrintedKeys::all) == text);
}

TEST_CASE("a term's keys are set by its name") {
    Scene scene = read_scene(kTwo, "file");
    apply_override(scene, "relief.crests.octaves=7", "");
    apply_override(scene, "relief.bent.of=[\"crests\"]", "");
    CHECK(std::get<strata::noise::Ridged>(scene.surface.relief[0].node).parameters.octaves == 7);
    CHECK_THROWS_WITH_AS(apply_override(scene, "relief.crests.octave=7", ""), doctest::Contains("did you mean"),
                         SceneError);
    CHECK_THROWS_AS(apply_override(scene, "relief.nothing.octaves=7", ""), SceneError);
}

TEST_CASE("a height curve's points are read, set and printed, and refused where they are no curve") {
    const std::string text = R"(image = "surface"
[[relief]]
name = "hills"
type = "fbm"
[[relief]]
name = "cliffs"
type = "curve"
of = ["hills"]
from = [-1, 0.0, 0.5]
to = [0.0, 0.25, 2]
)";
    Scene scene = read_scene(text, "file");
    const auto& curve = std::get<strata::noise::Curve>(scene.surface.relief[1].node);
    CHECK(curve.from == std::vector{-1.0, 0.0, 0.5});
    CHECK(curve.to == std::vector{0.0, 0.25, 2.0});
    CHECK_NOTHROW(validate(scene, ""));
    CHECK(print_scene(scene, PrintedKeys::all).find("from = [-1.0, 0.0, 0.5]") != std::string::npos);
    apply_override(scene, "relief.cliffs.to=[3, 2, 1]", "");
    CHECK(curve.to == std::vector{3.0, 2.0, 1.0});
    const std::vector<std::pair<std::string, std::string>> cases{
        {with(text, "[0.0, 0.25, 2]", "[0.0, 0.25]"), "relief.cliffs: from and to differ in number"},
        {with(text, "[-1, 0.0, 0.5]", "[-1, 0.0, 0.0]"), "relief.cliffs: from: not increasing"},
        {with(with(text, "[-1, 0.0, 0.5]", "[1]"), "[0.0, 0.25, 2]", "[1]"), "relief.cliffs: from: 2 to 16 numbers"},
        {with(text, "[-1, 0.0, 0.5]", "[-1, \"a\", 0.5]"), "file:9:13: relief.cliffs.from: wrong type"},
        {with(text, "[-1, 0.0, 0.5]", "[-1, 0.0, 1e9]"), "file:9:18: relief.cliffs.from: out of range"},
        {with(text, "[-1, 0.0, 0.5]", "3"), "file:9:8: relief.cliffs.from: wrong type"},
    };
    for (const auto& [bad, expected] : cases)
        CHECK_MESSAGE(refusal(bad).find(expected) != std::string::npos, refusal(bad));
}

TEST_CASE("a relief that cannot be is refused with its place") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {with(kTwo, "type = \"ridged\"\n", ""), "file:2:1: relief[0]: has no type"},
        {with(kTwo, "name = \"crests\"\n", ""), "file:2:1: relief[0]: has no name"},
        {with(kTwo, "\"ridged\"", "\"rigged\""), "file:4:8: relief.crests.type: unknown name (\"rigged\")"},
        {with(kTwo, "octaves = 5", "octaves = 99"), "file:5:11: relief.crests.octaves: out of range (99)"},
        {with(kTwo, "octaves = 5", "octave = 5"), "file:5:1: relief.crests.octave: unknown key"},
        {with(kTwo, "of = [\"crests\"]", "of = [\"crest\"]"), "file:10:6: relief.bent.of: unknown name (\"crest\")"},
        {with(kTwo, "of = [\"crests\"]\n", ""), "relief.bent.of: 0 names, allowed: 1 term before it"},
        {with(kTwo, "name = \"bent\"", "name = \"crests\""), "file:8:8: relief[1].name: there already"},
        {with(kTwo, "name = \"bent\"", "name = \"a.b\""), "file:8:8: relief[1].name: not a name"},
        {with(kTwo, "octaves = 5", "octaves = 32\nlacunarity = 9.0"), "too fine for double precision"},
        {"relief = 3\n", "file:1:10: relief: wrong type (3)"},
    };
    for (const auto& [text, expected] : cases)
        CHECK_MESSAGE(refusal(text).find(expected) != std::string::npos, refusal(text));
}

TEST_CASE("terms whose readings double from each to the next are refused before anything is computed of them") {
    std::string text = "image = \"surface\"\n[[relief]]\nname = \"t0\"\ntype = \"fbm\"\n";
    for (int i = 1; i < 60; ++i) {
        const std::string before = "\"t" + std::to_string(i - 1) + "\"";
        text += "[[relief]]\nname = \"t" + std::to_string(i) + "\"\ntype = \"sum\"\nof = [" + before + ", " + before +
                "]\n";
    }
    CHECK(refusal(text).find("relief.t16.of: a point of it takes 131071 readings of terms") != std::string::npos);
}

TEST_CASE("a mask whose ends are nearer than float can tell, and dunes finer than double can place, are refused") {
    const std::string hills =
        "image = \"surface\"\n[[relief]]\nname = \"a\"\ntype = \"fbm\"\n[[relief]]\nname = \"b\"\n";
    const std::string near = refusal(hills + "type = \"blend\"\nof = [\"a\", \"a\"]\nfrom = 1000.0\nto = 1000.001\n");
    CHECK_MESSAGE(near.find("relief.b: from and to are nearer than 1e-5") != std::string::npos, near);
    const std::string fine = refusal(
        "image = \"surface\"\ncamera.far = 1e10\n[[relief]]\nname = \"b\"\ntype = \"dunes\"\n"
        "wavelength = 1e-6\nwinding_size = 1e6\n");
    CHECK_MESSAGE(fine.find("too fine for double precision") != std::string::npos, fine);
}
