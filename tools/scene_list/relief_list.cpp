#include "tools/scene_list/relief_list.h"

#include <fmt/format.h>

#include <utility>
#include <variant>
#include <vector>

#include "src/scene/key_text.h"
#include "src/scene/relief_keys.h"

namespace strata::tools::scene_list {

namespace {

std::pair<int, int> inputs_of(const noise::ReliefTerm& term) {
    return std::visit([](const auto& node) { return std::pair(node.kFewestInputs, node.kMostInputs); }, term.node);
}

std::string inputs_text(const noise::ReliefTerm& term) {
    const auto [fewest, most] = inputs_of(term);
    if (most == 0) return "of no other term";
    const std::string count = fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most);
    return fmt::format("of {} other term{}", count, most == 1 ? "" : "s");
}

// The term over as many fBms with their defaults as it needs.
noise::Relief example_of(noise::ReliefTerm term) {
    std::vector<noise::ReliefTerm> terms;
    for (int i = 0; i < inputs_of(term).first; ++i) {
        noise::Fbm hills;
        hills.parameters.seed += static_cast<std::uint64_t>(i);
        terms.push_back({fmt::format("hills{}", i), {}, hills});
        term.of.push_back(terms.back().name);
    }
    term.name = "example";
    terms.push_back(std::move(term));
    return noise::Relief(terms, 2);
}

std::string kind_text(std::string_view type, noise::ReliefTerm term) {
    const noise::Relief example = example_of(term);
    const noise::Certificate& c = example.certificate();
    std::string text = fmt::format(
        "{}: {}\n  {}{}; {} octaves in all; heights {:.4g} to {:.4g}, slope {:.3g}, bend {:.3g}\n", type,
        scene::relief_meaning(term), inputs_text(term), scene::is_plane_only(term) ? ", over height fields alone" : "",
        example.evaluations(), c.low, c.high, c.slope, c.bend);
    for (const scene::Key& key : scene::describe_relief_term(term).keys) {
        if (key.name == "name" || key.name == "type" || key.name == "of") continue;
        text += fmt::format("    {:<14}{:<24}{}; {}\n", key.name, scene::value_text(key), key.meaning,
                            scene::allowed_text(key));
    }
    return text;
}

}  // namespace

std::string relief_list() {
    std::string text =
        "The kinds of [[relief]] terms. Bounds are those of the defaults, over fBms with their defaults.\n";
    const auto types = scene::relief_types();
    for (std::size_t i = 0; i < types.size(); ++i) text += "\n" + kind_text(types[i], scene::default_relief_term(i));
    return text;
}

}  // namespace strata::tools::scene_list
