// The settings of pictures side by side: what entries mean, how they are labelled, and what is refused.
#include "tools/job/column_settings.h"

#include <doctest/doctest.h>

#include <random>
#include <string>
#include <vector>

#include "src/scene/keys.h"
#include "src/scene/scene_error.h"
#include "tools/cli/errors.h"

using namespace strata::tools::cli;
using namespace strata::tools::job;
using namespace strata;

namespace {

using Words = std::vector<std::string>;

std::string refusal(const std::string& text) {
    try {
        parse_columns("--columns", text);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("entries are cut at ';', settings at blanks, whatever the blanks") {
    const auto columns = parse_columns("--columns", " none;N=2  m=1 ;\tsobol\tN=10 ; scene");
    REQUIRE(columns.size() == 4);
    CHECK(columns[0].assignments == Words{"sampling.estimator=none"});
    CHECK(columns[0].label == "no antialiasing");
    CHECK(columns[1].assignments == Words{"sampling.N=2", "sampling.m=1"});
    CHECK(columns[1].label == "N = 2, m = 1");
    CHECK(columns[1].text == "N=2  m=1");
    CHECK(columns[2].assignments == Words{"sampling.estimator=sobol", "sampling.N=10"});
    CHECK(columns[2].label == "sobol, N = 10");
    CHECK(columns[3].assignments.empty());
    CHECK(!columns[3].label.empty());
    CHECK(parse_column("--left", "scene label='as it is'").assignments.empty());
    CHECK(parse_column("--left", "scene label='as it is'").label == "as it is");
}

TEST_CASE("blanks and ';' within quotes and brackets belong to the value") {
    const auto columns = parse_columns("-x", "sun.direction=[1, 0.5, -2] label=\"a; b = c\"; title='x; y'");
    REQUIRE(columns.size() == 2);
    CHECK(columns[0].assignments == Words{"sun.direction=[1, 0.5, -2]"});
    CHECK(columns[0].label == "a; b = c");
    CHECK(columns[1].assignments == Words{"title='x; y'"});
    const scene::Scene scene = with_settings({}, columns[0], "-x");
    CHECK(scene.sun.direction == glm::dvec3(1.0, 0.5, -2.0));
}

TEST_CASE("every key's full name is itself, and its last part finds it wherever only one section has it") {
    scene::Scene any;
    const auto sections = scene::describe(any);
    int found = 0;
    for (const scene::Section& section : sections) {
        for (const scene::Key& key : section.keys) {
            CHECK(full_key_name("", key.full_name()) == key.full_name());
            int sharing = 0;
            for (const scene::Section& other : sections) {
                for (const scene::Key& candidate : other.keys) sharing += candidate.name == key.name;
            }
            if (sharing > 1) continue;
            CHECK(full_key_name("", key.name) == key.full_name());
            ++found;
        }
    }
    CHECK(found > 40);
    CHECK(full_key_name("", "l") == "sampling.time_order");
    CHECK(full_key_name("", "seed") == "sampling.seed");
}

TEST_CASE("settings change the scene as --set does, later ones win, and the result is validated") {
    scene::Scene base;
    base.sampling.N = 9;
    const scene::Scene changed = with_settings(base, parse_column("--left", "N=3 l=4 N=5 octaves=2"), "--left");
    CHECK(changed.sampling.N == 5);
    CHECK(changed.sampling.time_order == 4);
    CHECK(changed.surface.octaves == 2);
    CHECK(with_settings(base, parse_column("--left", "scene"), "--left").sampling.N == 9);
    CHECK_THROWS_WITH_AS(with_settings(base, parse_column("--left", "N=65"), "--left"),
                         doctest::Contains("--left 'N=65': sampling.N: out of range"), scene::SceneError);
    CHECK_THROWS_WITH_AS(with_settings(base, parse_column("--left", "look_at=[0,1,0]"), "--left"),
                         doctest::Contains("--left 'look_at=[0,1,0]': camera.look_at"), scene::SceneError);
}

TEST_CASE("what is no list of settings is refused with what is allowed") {
    CHECK(holds(refusal(""), "--columns '': an entry is empty"));
    CHECK(holds(refusal("none;;N=2"), "an entry is empty"));
    CHECK(holds(refusal("none;"), "an entry is empty"));
    CHECK(holds(refusal("nonne"), "did you mean 'none'?"));
    CHECK(holds(refusal("N 2"), "KEY=VALUE"));
    CHECK(holds(refusal("N= 2"), "N= has no value"));
    CHECK(holds(refusal("fov_dg=3"), "did you mean 'camera.fov_deg'?"));
    CHECK(holds(refusal("camera.fov=3"), "did you mean 'camera.fov_deg'?"));
    CHECK(holds(refusal("title=\"a"), "quote is not closed"));
    CHECK(holds(refusal("sun.direction=[1,2"), "brackets do not match"));
    CHECK(holds(refusal("N=2]"), "brackets do not match"));
    CHECK(holds(refusal("=2"), "unknown key"));
    CHECK_THROWS_WITH_AS(parse_column("--left", "none; N=2"), doctest::Contains("--left 'none; N=2': several entries"),
                         UsageError);
}

TEST_CASE("any text at all is either parsed or refused by a UsageError") {
    std::mt19937_64 random(11);
    const Words pieces{"N=2", " ", ";", "m=", "none", "label=", "'",      "\"", "[",
                       "]",   "{", "}", "\\", "=",    "4",      "gain=1", "é"};
    int parsed = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::string text;
        for (auto left = random() % 8; left > 0; --left) text += pieces[random() % pieces.size()];
        if (trial % 4 == 0) text = "N=2;" + text;
        try {
            for (const ColumnSettings& column : parse_columns("-x", text)) CHECK(!column.label.empty());
            ++parsed;
        } catch (const UsageError& error) {
            CHECK(std::string(error.what()).starts_with("-x"));
        }
    }
    CHECK(parsed > 50);
}
