// Lists of layers in a scene file, [[ground]] or [[clouds]]: each is a table of keys, which has a name among them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/toml_assign.h"

namespace strata::scene {

struct NamedList {
    std::string_view name;     // as in [[name]]
    std::string_view example;  // what a layer may be called
    std::size_t most;          // layers
};

// The list's tables; or what is wrong, in `fault`.
std::vector<const toml::table*> tables_of(const NamedList& list, const toml::node& node, MaybeFault& fault);

// Reads table `index`; `describe` gives the layer's section by the name that it has by then.
MaybeFault read_named_table(const NamedList& list, const toml::table& table, std::size_t index,
                            const std::function<Section()>& describe);

// At the key that the problem names, where the file has it.
Fault named_problem(const toml::table& table, std::string problem);

template <class Layer>
MaybeFault read_named_list(const NamedList& list, const toml::node& node, std::vector<Layer>& to,
                           Section (*describe)(Layer&),
                           std::string (*problem_of)(std::span<const Layer>, std::size_t)) {
    MaybeFault fault;
    std::vector<Layer> layers;
    for (const toml::table* table : tables_of(list, node, fault)) {
        const std::size_t i = layers.size();
        layers.emplace_back();
        fault = read_named_table(list, *table, i, [&] { return describe(layers.back()); });
        if (fault) return fault;
        if (std::string problem = problem_of(layers, i); !problem.empty())
            return named_problem(*table, std::move(problem));
    }
    if (!fault) to = std::move(layers);
    return fault;
}

// What is wrong with the name of layer i, seen from those before it.
template <class Layer>
std::string name_problem(std::string_view list, std::span<const Layer> layers, std::size_t i) {
    const std::string& name = layers[i].name;
    if (!is_name(name)) {
        return fmt::format(
            "{}[{}].name: not a name (\"{}\"), allowed: a letter, then letters, digits, '_' and '-', 64 at most", list,
            i, excerpt(name));
    }
    if (std::ranges::find(layers.first(i), name, &Layer::name) == layers.first(i).end()) return {};
    return fmt::format("{}[{}].name: there already (\"{}\"), allowed: a name that no other layer has", list, i, name);
}

}  // namespace strata::scene
