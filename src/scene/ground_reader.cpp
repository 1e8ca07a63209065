#include "src/scene/ground_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "src/scene/ground_keys.h"
#include "src/scene/key_lookup.h"

namespace strata::scene {

namespace {

Fault not_layers(const toml::node& node) {
    return fault_at(node.source().begin,
                    fmt::format("ground: wrong type ({}), allowed: layers, each [[ground]] with its keys below it, or "
                                "an array of tables",
                                node_text(node)));
}

// The name comes first, for messages; then the keys in the order of the file: a table iterates by name.
MaybeFault read_layer(GroundLayer& layer, const toml::table& table, std::size_t index) {
    const toml::node* named = table.get("name");
    if (named == nullptr) {
        return fault_at(table.source().begin,
                        fmt::format("ground[{}]: has no name, allowed: name = \"snow\" or the like", index));
    }
    const std::vector<Section> unnamed{describe_ground_layer(layer)};
    if (auto fault = assign_node(*find_key(unnamed.front(), "name"), *named)) return fault;
    const std::vector<Section> sections{describe_ground_layer(layer)};
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

// At the key that the problem names, where the file has it.
Fault problem_at(const toml::table& table, std::string problem) {
    const std::string key = problem.substr(0, problem.find(':'));
    const toml::node* node = table.get(key.substr(key.rfind('.') + 1));
    return fault_at(node != nullptr ? node->source().begin : table.source().begin, std::move(problem));
}

}  // namespace

MaybeFault read_ground(Scene& scene, const toml::node& node) {
    const auto* array = node.as_array();
    if (!array) return not_layers(node);
    if (array->size() > kMostGroundLayers) {
        return fault_at(node.source().begin,
                        fmt::format("ground: {} layers, allowed: {} at most", array->size(), kMostGroundLayers));
    }
    std::vector<GroundLayer> layers;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const auto* table = array->get(i)->as_table();
        if (!table) return not_layers(*array->get(i));
        layers.emplace_back();
        if (auto fault = read_layer(layers.back(), *table, i)) return fault;
        if (std::string problem = ground_problem(layers, i); !problem.empty())
            return problem_at(*table, std::move(problem));
    }
    scene.ground = std::move(layers);
    return std::nullopt;
}

}  // namespace strata::scene
