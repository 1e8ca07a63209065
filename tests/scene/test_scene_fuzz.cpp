// Damaged scene files: each is either read or refused with a SceneError that points into the file; nothing else
// happens. Run under the sanitizers as well.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "src/scene/builtin.h"
#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/override.h"
#include "src/scene/printer.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tests/scene/random_scene.h"

using namespace strata::scene;

namespace {

std::vector<std::string> whole_scenes() {
    std::vector<std::string> texts;
    for (const BuiltinScene& builtin : builtin_scenes()) {
        texts.emplace_back(builtin.text);
        texts.push_back(print_scene(read_scene(builtin.text, builtin.name)));
    }
    return texts;
}

std::size_t position_in(const std::string& text, Random& random) { return random() % (text.size() + 1); }

std::string damaged(std::string text, Random& random) {
    constexpr std::string_view kJunk = "\"'[]{}=.,#\n\r\t\\-+_0e9\xc3\xff\x80naif";
    switch (random() % 6) {
        case 0:
            return text.substr(0, position_in(text, random));
        case 1:
            for (auto left = 1 + random() % 4; left > 0 && !text.empty(); --left) {
                text[random() % text.size()] ^= static_cast<char>(1 << random() % 8);
            }
            return text;
        case 2:
            for (auto left = 1 + random() % 8; left > 0; --left) {
                text.insert(position_in(text, random), 1, kJunk[random() % kJunk.size()]);
            }
            return text;
        case 3:
            return text.erase(position_in(text, random), random() % 40);
        case 4: {
            const std::string piece = text.substr(position_in(text, random), random() % 60);
            return text.insert(position_in(text, random), piece);
        }
        default: {
            std::string noise(random() % 200, ' ');
            for (char& c : noise) c = static_cast<char>(random());
            return noise;
        }
    }
}

// What an accepted scene must satisfy.
void check_sound(Scene scene) {
    for (const Section& section : describe(scene)) {
        for (const Key& key : section.keys) CHECK(!field_problem(key));
    }
}

}  // namespace

TEST_CASE("damaged files are read as a sound scene or refused with a position inside the file") {
    Random random(20240607);
    const std::vector<std::string> texts = whole_scenes();
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string text = damaged(texts[random() % texts.size()], random);
        if (random() % 3 == 0) text = damaged(text, random);
        try {
            const Scene scene = read_scene(text, "fuzz.toml");
            ++read;
            check_sound(scene);
        } catch (const SceneError& error) {
            ++refused;
            const std::string message = error.what();
            CAPTURE(message);
            CAPTURE(text);
            unsigned long line = 0;
            unsigned long column = 0;
            REQUIRE(std::sscanf(message.c_str(), "fuzz.toml:%lu:%lu: ", &line, &column) == 2);
            const auto lines = static_cast<unsigned long>(1 + std::count(text.begin(), text.end(), '\n'));
            CHECK(line >= 1);
            CHECK(line <= lines);
            CHECK(column >= 1);
            CHECK(column <= text.size() + 1);
        }
    }
    MESSAGE("read " << read << ", refused " << refused);
    CHECK(read > 500);
    CHECK(refused > 500);
}

TEST_CASE("every beginning of a scene file is read or refused") {
    const std::string text(find_builtin("wheel")->text);
    int read = 0;
    for (std::size_t size = 0; size <= text.size(); ++size) {
        try {
            read_scene(std::string_view(text).substr(0, size), "cut.toml");
            ++read;
        } catch (const SceneError& error) {
            CHECK(std::string(error.what()).starts_with("cut.toml:"));
        }
    }
    CHECK(read > 10);
    CHECK(read < static_cast<int>(text.size()));
}

TEST_CASE("damaged overrides change the scene soundly or are refused and change nothing") {
    Random random(11);
    const std::vector<std::string> texts{"camera.fov_deg=35",           "camera.position=[1, 2.5, -3]",
                                         "sampling.estimator=sobol",    "title=\"a b\"",
                                         "surface.seed=0x7fffffffffff", "sun.shadows=false"};
    int changed = 0;
    int refused = 0;
    const std::string before = print_scene(Scene{}, PrintedKeys::all);
    for (int i = 0; i < 6000; ++i) {
        const std::string assignment = damaged(texts[random() % texts.size()], random);
        Scene scene;
        CAPTURE(assignment);
        try {
            apply_override(scene, assignment);
            ++changed;
            check_sound(scene);
        } catch (const SceneError& error) {
            ++refused;
            CHECK(std::string(error.what()).starts_with("--set "));
            if (i % 8 == 0) CHECK(print_scene(scene, PrintedKeys::all) == before);
        }
    }
    MESSAGE("changed " << changed << ", refused " << refused);
    CHECK(changed > 100);
    CHECK(refused > 1000);
}
