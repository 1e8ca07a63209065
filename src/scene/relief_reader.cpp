#include "src/scene/relief_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "src/scene/key_lookup.h"
#include "src/scene/key_text.h"
#include "src/scene/relief_keys.h"

namespace strata::scene {

namespace {

Fault not_terms(const toml::node& node) {
    return fault_at(node.source().begin,
                    fmt::format("relief: wrong type ({}), allowed: terms, each [[relief]] with its keys below it, or "
                                "an array of tables",
                                node_text(node)));
}

Fault missing(const toml::table& table, std::size_t index, std::string_view key, std::string_view allowed) {
    return fault_at(table.source().begin, fmt::format("relief[{}]: has no {}, allowed: {}", index, key, allowed));
}

// What messages and --set call the term; it may not have a name yet.
Section term_section(noise::ReliefTerm& term) { return describe_relief_term(term); }

// The type comes first, since it decides which keys there are.
MaybeFault read_term(noise::ReliefTerm& term, const toml::table& table, std::size_t index) {
    if (!table.contains("type")) {
        return missing(table, index, "type", fmt::format("type = {}", allowed_text(term_section(term).keys[1])));
    }
    if (!table.contains("name")) return missing(table, index, "name", "name = \"massif\" or the like");
    for (const std::string_view first : {"name", "type"}) {
        const Section section = term_section(term);
        if (auto fault = assign_node(*find_key(section, first), *table.get(first))) return fault;
    }
    // In the order of the file: a table iterates by name.
    std::vector<std::pair<toml::source_position, std::string>> names;
    for (auto&& [name, node] : table) names.emplace_back(name.source().begin, std::string(name.str()));
    std::ranges::sort(names, {}, [](const auto& name) { return std::pair(name.first.line, name.first.column); });
    const std::vector<Section> sections{term_section(term)};
    for (const auto& [at, name] : names) {
        const Key* key = find_key(sections.front(), name);
        if (!key) return fault_at(at, unknown_key(sections, sections.front().name, name));
        if (name == "name" || name == "type") continue;
        if (auto fault = assign_node(*key, *table.get(name))) return fault;
    }
    return std::nullopt;
}

}  // namespace

MaybeFault read_relief(Scene& scene, const toml::node& node) {
    const auto* array = node.as_array();
    if (!array) return not_terms(node);
    if (array->size() > kMostReliefTerms) {
        return fault_at(node.source().begin,
                        fmt::format("relief: {} terms, allowed: {} at most", array->size(), kMostReliefTerms));
    }
    std::vector<noise::ReliefTerm> terms;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const auto* table = array->get(i)->as_table();
        if (!table) return not_terms(*array->get(i));
        terms.push_back(default_relief_term(0));
        if (auto fault = read_term(terms.back(), *table, i)) return fault;
        if (std::string problem = relief_problem(terms, i); !problem.empty()) {
            const toml::node* of = table->get(problem.find(".of:") != std::string::npos ? "of" : "name");
            return fault_at(of != nullptr ? of->source().begin : table->source().begin, std::move(problem));
        }
    }
    scene.surface.relief = std::move(terms);
    return std::nullopt;
}

}  // namespace strata::scene
