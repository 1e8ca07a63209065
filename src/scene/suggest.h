// The known name that a misspelt one most likely meant: for keys, options, scenes and estimators.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace strata::scene {

// Damerau-Levenshtein distance (optimal string alignment): the least number of inserted, deleted or replaced bytes and
// swapped neighbours that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate nearest to word, letter case ignored; the first of equals. Nothing unless it is close: a third of the
// longer name may differ (names of one or two letters: case alone), or word is the beginning, three letters at least,
// of the candidate.
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates);

}  // namespace strata::scene
