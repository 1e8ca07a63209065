#include <doctest/doctest.h>
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "src/scene/key_text.h"
#include "src/scene/printer.h"
#include "src/scene/toml_reader.h"
#include "tests/scene/random_scene.h"

using namespace strata;
using namespace strata::scene;

namespace {

// The bits of every field, for comparison without ==, to which -0 equals 0.
std::vector<std::string> bits_of(Scene scene) {
    std::vector<std::string> bits;
    const auto number = [](double value) { return fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value)); };
    for (const Section& section : describe(scene)) {
        for (const Key& key : section.keys) {
            std::string text;
            if (auto* flag = std::get_if<bool*>(&key.field)) text = **flag ? "yes" : "no";
            if (auto* count = std::get_if<int*>(&key.field)) text = std::to_string(**count);
            if (auto* seed = std::get_if<std::uint64_t*>(&key.field)) text = std::to_string(**seed);
            if (auto* real = std::get_if<double*>(&key.field)) text = number(**real);
            if (auto* rate = std::get_if<Rate*>(&key.field)) {
                text = number((*rate)->numerator()) + number((*rate)->denominator());
            }
            if (auto* string = std::get_if<std::string*>(&key.field)) text = **string;
            if (auto* choice = std::get_if<Choice>(&key.field)) text = std::to_string(choice->get());
            if (auto* v = std::get_if<glm::dvec3*>(&key.field))
                text = number((*v)->x) + number((*v)->y) + number((*v)->z);
            if (auto* entries = std::get_if<std::vector<CameraKey>*>(&key.field)) {
                const auto triple = [&](const std::optional<glm::dvec3>& x) {
                    return x ? number(x->x) + number(x->y) + number(x->z) : std::string("none");
                };
                for (const CameraKey& entry : **entries) {
                    text += number(entry.time_s) + triple(entry.position) + triple(entry.look_at) +
                            (entry.fov_deg ? number(*entry.fov_deg) : std::string("none"));
                }
            }
            bits.push_back(key.full_name() + ":" + text);
        }
    }
    return bits;
}

void check_round_trip(const Scene& scene, PrintedKeys keys) {
    const std::string printed = print_scene(scene, keys);
    CAPTURE(printed);
    const Scene again = read_scene(printed, "printed.toml");
    CHECK(bits_of(again) == bits_of(scene));
    CHECK(print_scene(again, keys) == printed);
}

bool holds_line(const std::string& text, const std::string& beginning) {
    return text.starts_with(beginning) || text.find("\n" + beginning) != std::string::npos;
}

}  // namespace

TEST_CASE("random scenes print, read back to the same bits and print the same again") {
    Random random(42);
    for (int i = 0; i < 300; ++i) {
        const Scene scene = random_scene(random, i % 3 == 0 ? 1.0 : 0.2);
        check_round_trip(scene, i % 2 == 0 ? PrintedKeys::that_matter : PrintedKeys::all);
    }
}

TEST_CASE("random scenes are not all alike") {
    Random random(42);
    CHECK(bits_of(random_scene(random, 1.0)) != bits_of(random_scene(random, 1.0)));
    CHECK(bits_of(random_scene(random, 0.0)) == bits_of(Scene{}));
}

TEST_CASE("numbers print as the shortest TOML floats") {
    CHECK(number_text(2.0) == "2.0");
    CHECK(number_text(0.1) == "0.1");
    CHECK(number_text(-0.0) == "-0.0");
    CHECK(number_text(1e-9) == "1e-09");
    CHECK(number_text(1e300) == "1e+300");
    CHECK(number_text(0.30000000000000004) == "0.30000000000000004");
    CHECK(number_text(5e-324) == "5e-324");
}

TEST_CASE("strings print as TOML strings") {
    CHECK(quoted("a \"b\" \\ \n\x7f \u2603") == "\"a \\\"b\\\" \\\\ \\u000A\\u007F \u2603\"");
}

TEST_CASE("every printed key has its value and a comment with what it allows, its default and its meaning") {
    Scene scene;
    scene.camera.fov_deg = 35.0;
    const std::string text = print_scene(scene, PrintedKeys::all);
    for (const Section& section : describe(scene)) {
        if (!section.name.empty()) CHECK(holds_line(text, fmt::format("[{}]  # {}\n", section.name, section.meaning)));
        const std::size_t begin = section.name.empty() ? 0 : text.find(fmt::format("\n[{}]", section.name));
        const std::string part = text.substr(begin, text.find("\n[", begin + 1) - begin);
        for (const Key& key : section.keys) {
            CAPTURE(key.full_name());
            CHECK(holds_line(part, fmt::format("{} = {} ", key.name, value_text(key))));
            CHECK(part.find(allowed_text(key) + "; default ") != std::string::npos);
            CHECK(part.find(fmt::format(": {}\n", key.meaning)) != std::string::npos);
        }
    }
    CHECK(text.find("fov_deg = 35.0              # 0.01 to 179 degrees; default 50.0: horizontal field of view\n") !=
          std::string::npos);
}

TEST_CASE("of terms that have the same keys, the first alone explains them, and all give their values") {
    Scene scene;
    scene.sky.model = SkyModel::daylight;
    for (const char* name : {"low", "middle", "high"}) scene.clouds.push_back({.name = name, .coverage = 0.125});
    const std::string text = print_scene(scene);
    const auto times = [&](std::string_view words) {
        int found = 0;
        for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
        return found;
    };
    CHECK(times("\ncoverage = 0.125") == 3);
    CHECK(times("share of the sky where there is cloud") == 1);
    CHECK(read_scene(text, "printed").clouds.size() == 3);
}

TEST_CASE("only keys that matter to the picture are printed, unless they were changed") {
    Scene scene;
    const std::string terrain = print_scene(scene);
    for (const char* line : {"[camera]", "[surface]", "[sun]", "[sky]", "[material]", "octaves = ", "tolerance = "}) {
        CHECK(holds_line(terrain, line));
    }
    for (const char* line : {"[wheel]", "[zoneplate]", "[checker]", "radius = ", "threshold = ", "bound"}) {
        CHECK(!holds_line(terrain, line));
    }
    scene.surface.kind = solid::kKind<solid::Sphere>;
    CHECK(holds_line(print_scene(scene), "radius = "));
    CHECK(!holds_line(print_scene(scene), "bound = "));
    scene.surface.kind = solid::kKind<solid::LevelSet>;
    CHECK(holds_line(print_scene(scene), "bound_size = "));
    CHECK(!holds_line(print_scene(scene), "radius = "));

    Scene wheel;
    wheel.image = ImageKind::wheel;
    const std::string printed = print_scene(wheel);
    for (const char* line : {"[film]", "[sampling]", "[shutter]", "[wheel]", "spokes = 12 "}) {
        CHECK(holds_line(printed, line));
    }
    for (const char* line : {"[camera]", "[surface]", "[sun]", "tolerance = "}) CHECK(!holds_line(printed, line));
    wheel.surface.shape<solid::Sphere>().radius = 3.0;
    CHECK(holds_line(print_scene(wheel), "radius = 3.0 "));
}
