#include "src/scene/relief_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "src/scene/key_list.h"
#include "src/scene/key_text.h"

namespace strata::scene {

namespace {

using noise::ReliefNode;
using noise::ReliefTerm;

template <std::size_t... I>
constexpr std::array<std::string_view, sizeof...(I)> type_names(std::index_sequence<I...>) {
    return {std::variant_alternative_t<I, ReliefNode>::kType...};
}

constexpr std::size_t kTypes = std::variant_size_v<ReliefNode>;
constexpr auto kTypeNames = type_names(std::make_index_sequence<kTypes>{});

template <std::size_t I = 0>
ReliefNode default_node(std::size_t type) {
    if constexpr (I + 1 < kTypes) {
        if (type != I) return default_node<I + 1>(type);
    }
    return ReliefNode(std::in_place_index<I>);
}

std::string inputs_allowed(int fewest, int most) {
    if (most == 0) return "no `of`, it takes no other terms";
    if (fewest == most) return fmt::format("{} term{} before it", most, most == 1 ? "" : "s");
    return fmt::format("{} to {} terms before it", fewest, most);
}

std::string inputs_problem(std::span<const ReliefTerm> terms, std::size_t i) {
    const ReliefTerm& term = terms[i];
    const auto [fewest, most] =
        std::visit([](const auto& node) { return std::pair(node.kFewestInputs, node.kMostInputs); }, term.node);
    const auto count = static_cast<int>(term.of.size());
    if (count < fewest || count > most) {
        return fmt::format("relief.{}.of: {} names, allowed: {}", term.name, count, inputs_allowed(fewest, most));
    }
    for (const std::string& name : term.of) {
        const auto before = terms.first(i);
        if (std::ranges::find(before, name, &ReliefTerm::name) != before.end()) continue;
        std::vector<std::string_view> names;
        for (const ReliefTerm& other : before) names.push_back(other.name);
        return fmt::format("relief.{}.of: unknown name (\"{}\"), allowed: a term before it{}{}", term.name,
                           excerpt(name), names.empty() ? ", but it is the first" : ": ", fmt::join(names, ", "));
    }
    return {};
}

}  // namespace

std::span<const std::string_view> relief_types() { return kTypeNames; }

std::string_view relief_meaning(const ReliefTerm& term) {
    return std::visit([](const auto& node) { return node.kMeaning; }, term.node);
}

bool is_plane_only(const ReliefTerm& term) {
    return std::visit(
        [](const auto& node) {
            return requires { node.kPlaneOnly; };
        },
        term.node);
}

ReliefTerm default_relief_term(std::size_t type) { return {.name = {}, .of = {}, .node = default_node(type)}; }

Section describe_relief_term(ReliefTerm& term) {
    KeyList list;
    list.add({.section = {},
              .name = "name",
              .field = &term.name,
              .range = {},
              .unit = {},
              .meaning = "what later terms and --set call it"});
    list.add({.section = {},
              .name = "type",
              .field = Choice{kTypeNames, [&term] { return term.node.index(); },
                              [&term](std::size_t type) {
                                  if (type != term.node.index()) term.node = default_node(type);
                              }},
              .range = {},
              .unit = {},
              .meaning = relief_meaning(term)});
    list.add({.section = {},
              .name = "of",
              .field = &term.of,
              .range = {},
              .unit = {},
              .meaning = "the terms before it that it works on"});
    std::visit([&](auto& node) { node.keys(list); }, term.node);
    Section section{"relief." + term.name, relief_meaning(term), list.take(), true};
    for (Key& key : section.keys) key.section = section.name;
    return section;
}

std::string relief_problem(std::span<const ReliefTerm> terms, std::size_t i) {
    const ReliefTerm& term = terms[i];
    if (!is_name(term.name)) {
        return fmt::format(
            "relief[{}].name: not a name (\"{}\"), allowed: a letter, then letters, digits, '_' and '-', 64 at most", i,
            excerpt(term.name));
    }
    if (std::ranges::find(terms.first(i), term.name, &ReliefTerm::name) != terms.first(i).end()) {
        return fmt::format("relief[{}].name: there already (\"{}\"), allowed: a name that no other term has", i,
                           term.name);
    }
    const std::string problem = std::visit(
        [](const auto& node) -> std::string {
            if constexpr (requires { node.problem(); }) return node.problem();
            return {};
        },
        term.node);
    if (!problem.empty()) return fmt::format("relief.{}: {}", term.name, problem);
    return inputs_problem(terms, i);
}

}  // namespace strata::scene
