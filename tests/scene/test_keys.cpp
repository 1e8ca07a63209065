// Every key of the table, whichever there are: documented, settable, and refused outside what it allows.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "src/scene/key_lookup.h"
#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/override.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"

using namespace strata::scene;

namespace {

std::vector<Key> all_keys(Scene& scene) {
    std::vector<Key> keys;
    for (const Section& section : describe(scene)) keys.insert(keys.end(), section.keys.begin(), section.keys.end());
    return keys;
}

// A file that sets one key, and the position of its value.
struct OneKey {
    std::string text;
    std::size_t line;
    std::size_t column;
};

OneKey file_with(const Key& key, const std::string& value) {
    const std::string assignment = fmt::format("  {} = {}", key.name, value);
    const std::size_t column = assignment.size() - value.size() + 1;
    if (key.section.empty()) return {"# a scene\n" + assignment + "\n", 2, column};
    return {fmt::format("# a scene\n[{}]\n{}\n", key.section, assignment), 3, column};
}

std::string error_of(const std::string& text) {
    try {
        read_scene(text, "t.toml");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

// Checks that the reader refuses the value with the very problem, position and key. column_offset: from the value's
// beginning to what is at fault in it.
void check_file_refused(const Key& key, const std::string& value, const std::string& problem,
                        std::size_t column_offset = 0) {
    CAPTURE(value);
    const OneKey file = file_with(key, value);
    const std::string from_file = error_of(file.text);
    CHECK(from_file.starts_with(
        fmt::format("t.toml:{}:{}: {}: {}", file.line, file.column + column_offset, key.full_name(), problem)));
    CHECK(from_file.find("allowed: " + allowed_text(key)) != std::string::npos);
}

// The same, and that --set refuses it alike.
void check_refused(const Key& key, const std::string& value, const std::string& problem,
                   std::size_t column_offset = 0) {
    check_file_refused(key, value, problem, column_offset);
    CAPTURE(value);
    Scene scene;
    const std::string assignment = fmt::format("{}={}", key.full_name(), value);
    try {
        apply_override(scene, assignment);
        FAIL_CHECK("accepted " << assignment);
    } catch (const SceneError& error) {
        CHECK(std::string(error.what())
                  .starts_with(fmt::format("--set {}: {}: {}", assignment, key.full_name(), problem)));
    }
}

std::string as_value(const Key& key, double number) {
    const bool whole = std::holds_alternative<int*>(key.field);
    const std::string text = whole ? fmt::format("{}", static_cast<long long>(number)) : number_text(number);
    return std::holds_alternative<glm::dvec3*>(key.field) ? fmt::format("[{0}, {0}, {0}]", text) : text;
}

bool has_range(const Key& key) {
    return std::holds_alternative<int*>(key.field) || std::holds_alternative<double*>(key.field) ||
           std::holds_alternative<Rate*>(key.field) || std::holds_alternative<glm::dvec3*>(key.field);
}

}  // namespace

TEST_CASE("every key and section is documented, and no two share a name") {
    Scene scene;
    std::set<std::string> names;
    for (const Section& section : describe(scene)) {
        CHECK((section.name.empty() || !section.meaning.empty()));
        CHECK(names.insert(section.name).second);
        for (const Key& key : section.keys) {
            CAPTURE(key.full_name());
            CHECK(key.section == section.name);
            CHECK(key.meaning.size() >= 8);
            CHECK(!allowed_text(key).empty());
            if (has_range(key)) CHECK(key.range.min < key.range.max);
            CHECK(names.insert(key.full_name()).second);
        }
    }
    MESSAGE("keys: " << names.size() - describe(scene).size());
}

TEST_CASE("the printed ends of a range are the ends themselves") {
    Scene scene;
    for (const Key& key : all_keys(scene)) {
        if (!has_range(key)) continue;
        CAPTURE(key.full_name());
        CHECK(std::stod(fmt::format("{:g}", key.range.min)) == key.range.min);
        CHECK(std::stod(fmt::format("{:g}", key.range.max)) == key.range.max);
    }
}

TEST_CASE("the defaults of scene.h are within the ranges") {
    Scene scene;
    for (const Key& key : all_keys(scene)) {
        CAPTURE(key.full_name());
        CHECK(!field_problem(key));
    }
}

TEST_CASE("both ends of every range are accepted, and integers where numbers are wanted") {
    Scene scene;
    for (const Key& key : all_keys(scene)) {
        if (!has_range(key)) continue;
        CAPTURE(key.full_name());
        for (const double end : {key.range.min, key.range.max}) {
            CHECK(error_of(file_with(key, as_value(key, end)).text) == "");
        }
        const auto whole = static_cast<long long>(std::ceil(std::max(key.range.min, 0.0)));
        const std::string value = as_value(key, static_cast<double>(whole));
        if (!key.is_direction) {
            const bool vector = std::holds_alternative<glm::dvec3*>(key.field);
            const std::string bare = vector ? fmt::format("[{0}, {0}, {0}]", whole) : fmt::format("{}", whole);
            CHECK(error_of(file_with(key, bare).text) == "");
        }
    }
}

TEST_CASE("numbers outside every range, NaN and infinities are refused at their line and column") {
    Scene scene;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const Key& key : all_keys(scene)) {
        if (!has_range(key)) continue;
        CAPTURE(key.full_name());
        const bool whole = std::holds_alternative<int*>(key.field);
        const std::size_t inside = std::holds_alternative<glm::dvec3*>(key.field) ? 1 : 0;  // past the bracket
        const double below = whole ? key.range.min - 1 : std::nextafter(key.range.min, -kInfinity);
        const double above = whole ? key.range.max + 1 : std::nextafter(key.range.max, kInfinity);
        check_refused(key, as_value(key, below), "out of range (", inside);
        check_refused(key, as_value(key, above), "out of range (", inside);
        if (whole) {
            check_refused(key, "4.5", "must be an integer, written without a point or exponent (4.5)");
            // A file is held to its types; after --set 4.0 means 4.
            check_file_refused(key, "4.0", "must be an integer, written without a point or exponent (4.0)");
            check_refused(key, "nan", "must be an integer");
            check_refused(key, "9223372036854775807", "out of range (9223372036854775807)");
        } else {
            check_refused(key, as_value(key, std::nan("")), "not a finite number (nan)", inside);
            check_refused(key, as_value(key, kInfinity), "not a finite number (inf)", inside);
            check_refused(key, as_value(key, -kInfinity), "not a finite number (-inf)", inside);
        }
    }
}

TEST_CASE("a wrong type is refused for every key at its line and column") {
    Scene scene;
    for (const Key& key : all_keys(scene)) {
        CAPTURE(key.full_name());
        // After --set a text needs no quotes, so that whatever is written there is one.
        const auto refused = std::holds_alternative<std::string*>(key.field) ? check_file_refused : check_refused;
        const bool text = std::holds_alternative<std::string*>(key.field) || std::holds_alternative<Choice>(key.field);
        const bool flag = std::holds_alternative<bool*>(key.field);
        const bool vector = std::holds_alternative<glm::dvec3*>(key.field);
        if (!text) refused(key, "\"words\"", "wrong type, a string (\"words\")", 0);
        if (!flag) refused(key, "true", "wrong type, true or false (true)", 0);
        if (text || flag || vector) refused(key, "3", "wrong type, an integer (3)", 0);
        const bool entries = std::holds_alternative<std::vector<CameraKey>*>(key.field);
        if (!vector && !entries) refused(key, "[1, 2, 3]", "wrong type (an array of 3)", 0);
        if (entries) refused(key, "[1, 2, 3]", "wrong type, an integer (1)", 1);
        refused(key, "1979-05-27", "wrong type (a date or time)", 0);
        refused(key, "{ x = 1 }", "wrong type (a table)", 0);
    }
}

TEST_CASE("seeds end where TOML integers end, and directions must have a length") {
    Scene scene;
    int seeds = 0;
    int directions = 0;
    for (const Key& key : all_keys(scene)) {
        CAPTURE(key.full_name());
        if (std::holds_alternative<std::uint64_t*>(key.field)) {
            ++seeds;
            CHECK(error_of(file_with(key, "9223372036854775807").text) == "");
            check_refused(key, "-1", "out of range (-1)");
            check_refused(key, "1.5", "must be an integer");
        }
        if (key.is_direction) {
            ++directions;
            check_refused(key, "[0, 0, 0]", "too short to be a direction ([0.0, 0.0, 0.0])");
            check_refused(key, "[0, 1e-13, 0]", "too short to be a direction (");
            CHECK(error_of(file_with(key, "[0, 1e-12, 0]").text) == "");
        }
        if (std::holds_alternative<glm::dvec3*>(key.field)) {
            check_refused(key, "[1, 1]", "not 3 numbers (an array of 2)");
            check_refused(key, "[]", "not 3 numbers (an array of 0)");
            check_refused(key, "[1, 1, \"z\"]", "wrong type, a string (\"z\")", 7);
            check_refused(key, "[1, 1e300, 1]", "out of range (1e+300)", 4);
        }
    }
    CHECK(seeds == 2);
    CHECK(directions == 3);
}

TEST_CASE("every name of every choice is accepted and a misspelt one gets the right one suggested") {
    Scene scene;
    for (const Key& key : all_keys(scene)) {
        const auto* choice = std::get_if<Choice>(&key.field);
        if (!choice) continue;
        for (std::size_t i = 0; i < choice->names.size(); ++i) {
            const std::string name(choice->names[i]);
            apply_override(scene, fmt::format("{}={}", key.full_name(), name));
            CHECK(choice->get() == i);
            if (name.size() < 5) continue;
            const std::string slip = name + name.back();
            CHECK(error_of(file_with(key, '"' + slip + '"').text).ends_with(fmt::format("did you mean '{}'?", name)));
        }
    }
}

TEST_CASE("a misspelt key gets the right one suggested, in its own section, in a wrong one and without one") {
    Scene scene;
    const std::vector<Section> sections = describe(scene);
    int suggested = 0;
    for (const Key& key : all_keys(scene)) {
        if (key.name.size() < 5 || key.section.empty()) continue;
        const std::string slip = key.name + key.name.back();
        CAPTURE(key.full_name());
        const std::string meant = fmt::format("did you mean '{}'?", key.full_name());
        CHECK(error_of(fmt::format("[{}]\n{} = 1\n", key.section, slip)).ends_with(meant));
        CHECK(unknown_key(sections, key.section + "x", key.name).find(meant) != std::string::npos);
        // `scale` is a section too, and the message says so.
        const bool is_section = find_section(sections, key.name) != nullptr;
        const std::string found = is_section ? fmt::format("one section [{}]", key.name) : "did you mean '";
        CHECK(error_of(fmt::format("{} = 1\n", key.name)).find(found) != std::string::npos);
        ++suggested;
    }
    CHECK(suggested > 20);
}

TEST_CASE("validate refuses by name whatever field of a scene was put out of range by other means") {
    Scene scene;
    const std::vector<Key> keys = all_keys(scene);
    const Scene untouched = scene;
    for (const Key& key : keys) {
        CAPTURE(key.full_name());
        if (auto* count = std::get_if<int*>(&key.field)) **count = -1;
        if (auto* number = std::get_if<double*>(&key.field)) **number = std::nan("");
        if (auto* rate = std::get_if<Rate*>(&key.field)) **rate = std::nan("");
        if (auto* vector = std::get_if<glm::dvec3*>(&key.field)) (**vector).z = -2e12;
        if (auto* seed = std::get_if<std::uint64_t*>(&key.field)) **seed = kLargestSeed + 1;
        if (!has_range(key) && !std::holds_alternative<std::uint64_t*>(key.field)) continue;
        try {
            validate(scene, "picture.exr");
            FAIL_CHECK("accepted");
        } catch (const SceneError& error) {
            CHECK(std::string(error.what()).starts_with(fmt::format("picture.exr: {}: ", key.full_name())));
        }
        scene = untouched;
    }
}
