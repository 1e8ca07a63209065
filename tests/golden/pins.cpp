#include "tests/golden/pins.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace strata::golden {

namespace {

constexpr const char* kHeader =
    "# Bits of the golden scenes' pixels, and the work they took, on the SIMD target {0}. Written by "
    "tests/golden/pin.\n"
    "# Counts are those of one thread and tiles of {1} pixels.\n"
    "# Where compiler and maths library agree with these, every number must; elsewhere the last bits may differ.\n";

// "shadows.steps" is `steps` in the line `shadows`.
std::pair<std::string, std::string> split(const std::string& name) {
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) throw PinError(name + " belongs to no line");
    return {name.substr(0, dot), name.substr(dot + 1)};
}

// Counts of one line follow one another.
std::string print_record(const Record& record) {
    std::string text, open;
    for (const auto& [name, digest] : record.digests) text += fmt::format("{} = \"{}\"\n", name, digest);
    for (const auto& [name, count] : record.counts) {
        if (count == 0) continue;
        const auto [line, what] = split(name);
        if (line == open) {
            text += fmt::format(", {} = {}", what, count);
        } else {
            text += fmt::format("{}{} = {{ {} = {}", open.empty() ? "" : " }\n", line, what, count);
        }
        open = line;
    }
    return open.empty() ? text : text + " }\n";
}

template <class T>
T require(const toml::node& node, const std::string& what) {
    if (const auto value = node.value_exact<T>()) return *value;
    throw PinError(what + " is of the wrong type");
}

std::string require_text(const toml::table& table, const std::string& key) {
    const toml::node* node = table.get(key);
    if (!node) throw PinError(key + " is missing");
    return require<std::string>(*node, key);
}

std::uint64_t require_count(const toml::node& node, const std::string& name) {
    const auto count = require<std::int64_t>(node, name);
    if (count < 0) throw PinError(name + " is negative");
    return static_cast<std::uint64_t>(count);
}

const toml::table& require_table(const toml::node& node, const std::string& what) {
    if (const toml::table* table = node.as_table()) return *table;
    throw PinError(what + " is not a table");
}

Record record_from(const toml::table& table) {
    Record record;
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        if (node.is_string()) {
            record.digests.emplace_back(name, require<std::string>(node, name));
            continue;
        }
        for (const auto& [what, count] : require_table(node, name)) {
            const std::string full = name + "." + std::string(what.str());
            record.counts.emplace_back(full, require_count(count, full));
        }
    }
    return record;
}

Pins pins_from(const toml::table& root) {
    Pins pins;
    bool has_environment = false;
    for (const auto& [key, node] : root) {
        const std::string name(key.str());
        const toml::table& table = require_table(node, name);
        if (name == "environment") {
            has_environment = true;
            pins.environment = {require_text(table, "compiler"), require_text(table, "libm"),
                                require_text(table, "libc")};
        } else {
            pins.scenes[name] = record_from(table);
        }
    }
    if (!has_environment) throw PinError("[environment] is missing");
    return pins;
}

// The names of both, each once, in the order of `got`.
template <class T>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, T>>& got,
                                  const std::vector<std::pair<std::string, T>>& expected) {
    std::vector<std::string> names;
    for (const auto* list : {&got, &expected}) {
        for (const auto& entry : *list) {
            if (std::find(names.begin(), names.end(), entry.first) == names.end()) names.push_back(entry.first);
        }
    }
    return names;
}

template <class T>
T value_of(const std::vector<std::pair<std::string, T>>& list, const std::string& name, const T& otherwise) {
    for (const auto& entry : list) {
        if (entry.first == name) return entry.second;
    }
    return otherwise;
}

template <class T>
void compare(const std::vector<std::pair<std::string, T>>& expected, const std::vector<std::pair<std::string, T>>& got,
             const T& otherwise, std::vector<std::string>& lines) {
    for (const std::string& name : names_of(got, expected)) {
        const T wanted = value_of(expected, name, otherwise), found = value_of(got, name, otherwise);
        if (wanted != found) lines.push_back(fmt::format("{}: expected {}, got {}", name, wanted, found));
    }
}

}  // namespace

std::string print_pins(const Pins& pins, const std::string& target) {
    std::string text = fmt::format(fmt::runtime(kHeader), target, kPinnedCut.tile);
    text += fmt::format("\n[environment]\ncompiler = \"{}\"\nlibm = \"{}\"\nlibc = \"{}\"\n", pins.environment.compiler,
                        pins.environment.libm, pins.environment.libc);
    for (const auto& [name, record] : pins.scenes) text += fmt::format("\n[{}]\n{}", name, print_record(record));
    return text;
}

Pins parse_pins(const std::string& text, const std::string& source_name) {
    try {
        return pins_from(toml::parse(text));
    } catch (const toml::parse_error& error) {
        throw PinError(fmt::format("{}:{}: {}", source_name, error.source().begin.line, error.description()));
    } catch (const PinError& error) {
        throw PinError(source_name + ": " + error.what());
    }
}

Pins load_pins(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) {
        throw PinError("cannot read " + path.string() + "; tests/golden/pin makes it");
    }
    return parse_pins(text.str(), path.string());
}

std::vector<std::string> differences(const Record& expected, const Record& got) {
    std::vector<std::string> lines;
    compare(expected.digests, got.digests, std::string("nothing"), lines);
    compare(expected.counts, got.counts, std::uint64_t{0}, lines);
    return lines;
}

}  // namespace strata::golden
