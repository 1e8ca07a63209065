#include "src/scene/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "src/scene/cloud_reader.h"
#include "src/scene/ground_reader.h"
#include "src/scene/key_lookup.h"
#include "src/scene/key_text.h"
#include "src/scene/relief_reader.h"
#include "src/scene/scene_text.h"
#include "src/scene/toml_assign.h"
#include "src/scene/typed_value.h"

namespace strata::scene {

namespace {

std::string located(std::string_view source_name, const Fault& fault) {
    return fmt::format("{}:{}:{}: {}", source_name, fault.line, fault.column, fault.message);
}

// One name with what the file says about it. node is null for a section of unknown name.
struct Entry {
    toml::source_position at;
    std::string section;
    std::string name;
    const toml::node* node;
};

// Everything in the file, in the order of the file: a table iterates by name.
std::vector<Entry> entries_in_order(const toml::table& file, std::span<const Section> sections) {
    std::vector<Entry> entries;
    for (auto&& [top_key, top_node] : file) {
        const std::string top(top_key.str());
        const toml::table* table = top_node.as_table();
        const bool is_key = find_key(sections.front(), top) != nullptr;
        if (top == kReliefTerms || top == kGroundLayers || top == kCloudLayers) {
            entries.push_back({top_key.source().begin, top, "", &top_node});
        } else if (!table || is_key) {
            entries.push_back({top_key.source().begin, "", top, &top_node});
        } else if (top.empty() || !find_section(sections, top)) {
            entries.push_back({top_key.source().begin, top, "", nullptr});
        } else {
            for (auto&& [key, node] : *table) {
                entries.push_back({key.source().begin, top, std::string(key.str()), &node});
            }
        }
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::pair(a.at.line, a.at.column) < std::pair(b.at.line, b.at.column);
    });
    return entries;
}

MaybeFault assign_entry(Scene& scene, std::span<const Section> sections, const Entry& entry) {
    if (entry.section == kReliefTerms) return read_relief(scene, *entry.node);
    if (entry.section == kGroundLayers) return read_ground(scene, *entry.node);
    if (entry.section == kCloudLayers) return read_clouds(scene, *entry.node);
    if (!entry.node) return fault_at(entry.at, unknown_section(sections, entry.section));
    const Key* key = find_key(*find_section(sections, entry.section), entry.name);
    if (key) return assign_node(*key, *entry.node);
    if (entry.section.empty() && !entry.name.empty() && find_section(sections, entry.name)) {
        return fault_at(entry.at, fmt::format("{0}: wrong type ({1}), allowed: one section [{0}] of keys", entry.name,
                                              node_text(*entry.node)));
    }
    return fault_at(entry.at, unknown_key(sections, entry.section, entry.name));
}

MaybeFault read_entries(const toml::table& file, Scene& scene) {
    const std::vector<Section> sections = describe(scene);
    const std::vector<Entry> entries = entries_in_order(file, sections);
    if (entries.empty()) {
        return Fault{1, 1,
                     "empty, allowed: a scene file holds at least one key, such as image = \"surface\"; `strata scenes "
                     "hills` prints one with every key explained"};
    }
    for (const Entry& entry : entries) {
        if (auto fault = assign_entry(scene, sections, entry)) return fault;
    }
    return std::nullopt;
}

std::variant<toml::table, Fault> parse(std::string_view text) {
    if (auto fault = find_unreadable(text)) return *fault;
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        return fault_at(error.source().begin, fmt::format("syntax: {}", error.description()));
    }
}

MaybeFault read_into(Scene& scene, std::string_view text) {
    const auto parsed = parse(text);
    if (const auto* fault = std::get_if<Fault>(&parsed)) return *fault;
    return read_entries(std::get<toml::table>(parsed), scene);
}

}  // namespace

Scene read_scene(std::string_view text, std::string_view source_name) {
    Scene scene;
    if (const auto fault = read_into(scene, text)) throw SceneError(located(source_name, *fault));
    return scene;
}

Scene load_scene(const std::string& path) { return read_scene(file_text(path), path); }

void assign_value(const Key& key, std::string_view typed) {
    constexpr std::string_view kName = "value";
    auto parsed = parse(fmt::format("{} = {}", kName, toml_of_typed(key, typed)));
    const bool is_fraction = std::holds_alternative<Rate*>(key.field) && parse_fraction(typed);
    if (std::holds_alternative<Fault>(parsed) && (is_fraction || is_bare_word(typed))) {
        parsed = parse(fmt::format("{} = {}", kName, quoted(typed)));
    }
    const auto* table = std::get_if<toml::table>(&parsed);
    // A line break in the value could start further keys.
    if (!table || table->size() != 1) {
        throw SceneError(complaint(key, "not a value", typed.empty() ? "nothing" : excerpt(typed)));
    }
    if (const auto fault = assign_node(key, *table->get(kName))) throw SceneError(fault->message);
}

}  // namespace strata::scene
