#include "src/scene/key_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <type_traits>

namespace strata::scene {

namespace {

constexpr std::size_t kLongestExcerpt = 120;  // bytes

template <class... Functions>
struct Overload : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Overload(Functions...) -> Overload<Functions...>;

std::string range_text(const Key& key) { return fmt::format("{:g} to {:g}", key.range.min, key.range.max); }

std::string choice_text(const Choice& choice) {
    std::string text;
    for (std::string_view name : choice.names) text += (text.empty() ? "" : ", ") + quoted(name);
    return text;
}

std::string vector_text(const Key& key) {
    const std::string direction = key.is_direction ? fmt::format(", length {} or more", kShortestDirection) : "";
    const std::string unit = key.unit.empty() ? "" : fmt::format(" ({})", key.unit);
    return fmt::format("3 numbers from {}{}{}", range_text(key), unit, direction);
}

std::string triple_text(const glm::dvec3& v) {
    return fmt::format("[{}, {}, {}]", number_text(v.x), number_text(v.y), number_text(v.z));
}

// A fraction is no number of TOML.
std::string rate_text(const Rate& rate) {
    const std::string text = rate.text();
    return text.find('/') == std::string::npos ? text : quoted(text);
}

std::string camera_keys_text(const std::vector<CameraKey>& entries) {
    if (entries.empty()) return "[]";
    std::string text = "[\n";
    for (const CameraKey& entry : entries) text += fmt::format("  {},\n", camera_key_text(entry));
    return text + "]";
}

std::string names_text(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + quoted(name);
    return "[" + text + "]";
}

std::string numbers_text(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "" : ", ") + number_text(number);
    return "[" + text + "]";
}

// Control characters as TOML escapes them in strings.
std::string without_controls(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) {
            result += fmt::format("\\u{:04X}", byte);
        } else {
            result += c;
        }
    }
    return result;
}

}  // namespace

bool is_name(std::string_view name) {
    const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
    return !name.empty() && name.size() <= 64 && std::isalpha(static_cast<unsigned char>(name.front())) != 0 &&
           std::ranges::all_of(name, is_word);
}

std::string number_text(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
    return text;
}

std::string quoted(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += without_controls({&c, 1});
    }
    return fmt::format("\"{}\"", result);
}

std::string excerpt(std::string_view text) {
    if (text.size() <= kLongestExcerpt) return without_controls(text);
    std::size_t cut = kLongestExcerpt;
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xc0) == 0x80) --cut;
    return without_controls(text.substr(0, cut)) + "...";
}

std::string camera_key_text(const CameraKey& entry) {
    std::string text = fmt::format("{{ time_s = {}", number_text(entry.time_s));
    if (entry.position) text += ", position = " + triple_text(*entry.position);
    if (entry.look_at) text += ", look_at = " + triple_text(*entry.look_at);
    if (entry.fov_deg) text += ", fov_deg = " + number_text(*entry.fov_deg);
    return text + " }";
}

std::optional<std::string> time_problem(const std::vector<CameraKey>& entries, std::size_t i) {
    if (i == 0 || entries[i].time_s - entries[i - 1].time_s >= kLeastKeyGap_s) return std::nullopt;
    const std::string before = number_text(entries[i - 1].time_s);
    if (entries[i].time_s == entries[i - 1].time_s) return fmt::format("the time of the entry before it ({})", before);
    return fmt::format("not {:g} s later than the entry before it ({})", kLeastKeyGap_s, before);
}

std::string value_text(const Key& key) {
    return std::visit(Overload{[](const bool* field) { return std::string(*field ? "true" : "false"); },
                               [](const double* field) { return number_text(*field); },
                               [](const Rate* field) { return rate_text(*field); },
                               [](const glm::dvec3* field) { return triple_text(*field); },
                               [](const std::vector<CameraKey>* field) { return camera_keys_text(*field); },
                               [](const std::string* field) { return quoted(*field); },
                               [](const std::vector<std::string>* field) { return names_text(*field); },
                               [](const std::vector<double>* field) { return numbers_text(*field); },
                               [](const Choice& choice) { return quoted(choice.names[choice.get()]); },
                               [](const auto* integer) { return fmt::format("{}", *integer); }},
                      key.field);
}

std::string allowed_text(const Key& key) {
    std::string text = std::visit(
        Overload{[](const bool*) { return std::string("true or false"); },
                 [&](const int*) { return fmt::format("integers {:.0f} to {:.0f}", key.range.min, key.range.max); },
                 [](const std::uint64_t*) { return fmt::format("integers 0 to {}", kLargestSeed); },
                 [&](const double*) { return range_text(key); }, [&](const Rate*) { return range_text(key); },
                 [&](const glm::dvec3*) { return vector_text(key); },
                 [](const std::string*) { return std::string("text in quotes"); },
                 [](const std::vector<std::string>*) { return std::string("names in quotes, between [ and ]"); },
                 [&](const std::vector<double>*) { return fmt::format("numbers {}", range_text(key)); },
                 [](const std::vector<CameraKey>*) {
                     return fmt::format(
                         "up to {} tables of time_s (s, increasing by {:g} or more) and any of position, look_at, "
                         "fov_deg",
                         kMostCameraKeys, kLeastKeyGap_s);
                 },
                 [](const Choice& choice) { return choice_text(choice); }},
        key.field);
    const bool is_vector = std::holds_alternative<glm::dvec3*>(key.field);
    if (!key.unit.empty() && !is_vector) text += fmt::format(" {}", key.unit);
    return text;
}

std::optional<std::string> number_problem(const Key& key, double value) {
    if (!std::isfinite(value)) return "not a finite number";
    if (value < key.range.min || value > key.range.max) return "out of range";
    return std::nullopt;
}

std::optional<std::string> field_problem(const Key& key) {
    if (const auto* number = std::get_if<double*>(&key.field)) return number_problem(key, **number);
    if (const auto* rate = std::get_if<Rate*>(&key.field)) return number_problem(key, **rate);
    if (const auto* integer = std::get_if<int*>(&key.field)) return number_problem(key, **integer);
    if (const auto* seed = std::get_if<std::uint64_t*>(&key.field)) {
        if (**seed > kLargestSeed) return "out of range";
    }
    if (const auto* entries = std::get_if<std::vector<CameraKey>*>(&key.field)) {
        if ((*entries)->size() > kMostCameraKeys) return fmt::format("{} entries, too many", (*entries)->size());
        for (std::size_t i = 0; i < (*entries)->size(); ++i) {
            if (auto problem = time_problem(**entries, i)) return fmt::format("time_s of entry {} is {}", i, *problem);
        }
    }
    if (const auto* numbers = std::get_if<std::vector<double>*>(&key.field)) {
        for (const double number : **numbers) {
            if (auto problem = number_problem(key, number)) return problem;
        }
    }
    if (const auto* vector = std::get_if<glm::dvec3*>(&key.field)) {
        const glm::dvec3& value = **vector;
        for (int i = 0; i < 3; ++i) {
            if (auto problem = number_problem(key, value[i])) return problem;
        }
        if (key.is_direction && glm::length(value) < kShortestDirection) return "too short to be a direction";
    }
    return std::nullopt;
}

std::string complaint(const Key& key, std::string_view problem, std::string_view value) {
    return fmt::format("{}: {} ({}), allowed: {}", key.full_name(), problem, value, allowed_text(key));
}

}  // namespace strata::scene
