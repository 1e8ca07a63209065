#include "src/scene/key_lookup.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "src/scene/key_text.h"
#include "src/scene/suggest.h"

namespace strata::scene {

namespace {

template <class Named>
std::vector<std::string> names_of(std::span<const Named> items) {
    std::vector<std::string> names;
    for (const Named& item : items) {
        if (!item.name.empty()) names.push_back(item.name);
    }
    return names;
}

std::string joined(std::span<const std::string> names) {
    return fmt::format("{}", fmt::join(names.begin(), names.end(), ", "));
}

std::string dotted(std::string_view section, std::string_view name) {
    const std::string last = name.empty() ? "\"\"" : excerpt(name);
    return section.empty() ? last : fmt::format("{}.{}", excerpt(section), last);
}

std::optional<std::string> meant_in(const Section& section, std::string_view name) {
    const auto near = nearest(name, names_of<Key>(section.keys));
    if (!near) return std::nullopt;
    return find_key(section, *near)->full_name();
}

// A slip in this section, then the right name in a wrong section, then a slip in any section.
std::optional<std::string> meant_key(std::span<const Section> sections, const Section* section, std::string_view name) {
    if (section) {
        if (auto meant = meant_in(*section, name)) return meant;
    }
    for (const Section& other : sections) {
        if (const Key* key = find_key(other, name)) return key->full_name();
    }
    for (const Section& other : sections) {
        if (auto meant = meant_in(other, name)) return meant;
    }
    return std::nullopt;
}

}  // namespace

KeyPath key_path(std::string_view full_name) {
    const auto dot = full_name.rfind('.');
    if (dot == std::string_view::npos) return {"", full_name};
    return {full_name.substr(0, dot), full_name.substr(dot + 1)};
}

const Section* find_section(std::span<const Section> sections, std::string_view name) {
    const auto found = std::find_if(sections.begin(), sections.end(), [&](const Section& s) { return s.name == name; });
    return found == sections.end() ? nullptr : &*found;
}

const Key* find_key(const Section& section, std::string_view name) {
    const auto found =
        std::find_if(section.keys.begin(), section.keys.end(), [&](const Key& key) { return key.name == name; });
    return found == section.keys.end() ? nullptr : &*found;
}

std::string unknown_key(std::span<const Section> sections, std::string_view section, std::string_view name) {
    const Section* known = find_section(sections, section);
    const std::vector<std::string> section_names = names_of<Section>(sections);
    std::string text = dotted(section, name) + ": unknown key, allowed ";
    if (known && !section.empty()) {
        text += fmt::format("in [{}]: {}", section, joined(names_of<Key>(known->keys)));
    } else {
        text += fmt::format("outside sections: {}; sections: {}", joined(names_of<Key>(sections.front().keys)),
                            joined(section_names));
    }
    if (!known) {
        if (const auto near = nearest(section, section_names)) known = find_section(sections, *near);
    }
    if (const auto meant = meant_key(sections, known, name)) text += fmt::format(", did you mean '{}'?", *meant);
    return text;
}

std::string unknown_section(std::span<const Section> sections, std::string_view name) {
    const std::vector<std::string> names = names_of<Section>(sections);
    std::string text =
        fmt::format("{}: unknown section, allowed: {}", name.empty() ? "\"\"" : excerpt(name), joined(names));
    if (const auto near = nearest(name, names)) text += fmt::format(", did you mean '{}'?", *near);
    return text;
}

}  // namespace strata::scene
