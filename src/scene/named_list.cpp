#include "src/scene/named_list.h"

#include "src/scene/key_lookup.h"

namespace strata::scene {

namespace {

Fault not_layers(const NamedList& list, const toml::node& node) {
    return fault_at(node.source().begin,
                    fmt::format("{0}: wrong type ({1}), allowed: layers, each [[{0}]] with its keys below it, or an "
                                "array of tables",
                                list.name, node_text(node)));
}

}  // namespace

std::vector<const toml::table*> tables_of(const NamedList& list, const toml::node& node, MaybeFault& fault) {
    std::vector<const toml::table*> tables;
    const auto* array = node.as_array();
    if (!array) {
        fault = not_layers(list, node);
        return {};
    }
    if (array->size() > list.most) {
        fault = fault_at(node.source().begin,
                         fmt::format("{}: {} layers, allowed: {} at most", list.name, array->size(), list.most));
        return {};
    }
    for (const toml::node& entry : *array) {
        if (entry.is_table()) {
            tables.push_back(entry.as_table());
        } else {
            fault = not_layers(list, entry);
            return {};
        }
    }
    return tables;
}

// The name comes first, for messages; then the keys in the order of the file: a table iterates by name.
MaybeFault read_named_table(const NamedList& list, const toml::table& table, std::size_t index,
                            const std::function<Section()>& describe) {
    const toml::node* named = table.get("name");
    if (named == nullptr) {
        return fault_at(table.source().begin, fmt::format("{}[{}]: has no name, allowed: name = \"{}\" or the like",
                                                          list.name, index, list.example));
    }
    const Section unnamed = describe();
    if (auto fault = assign_node(*find_key(unnamed, "name"), *named)) return fault;
    const std::vector<Section> sections{describe()};
    std::vector<std::pair<toml::source_position, std::string>> names;
    for (auto&& [name, node] : table) names.emplace_back(name.source().begin, std::string(name.str()));
    std::ranges::sort(names, {}, [](const auto& name) { return std::pair(name.first.line, name.first.column); });
    for (const auto& [at, name] : names) {
        const Key* key = find_key(sections.front(), name);
        if (!key) return fault_at(at, unknown_key(sections, sections.front().name, name));
        if (auto fault = assign_node(*key, *table.get(name))) return fault;
    }
    return std::nullopt;
}

Fault named_problem(const toml::table& table, std::string problem) {
    const std::string key = problem.substr(0, problem.find(':'));
    const toml::node* node = table.get(key.substr(key.rfind('.') + 1));
    return fault_at(node != nullptr ? node->source().begin : table.source().begin, std::move(problem));
}

}  // namespace strata::scene
