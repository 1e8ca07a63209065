// The terms of a scene's relief ([[relief]] in a scene file) as sections of keys. The keys of each kind of term are its
// node's own (noise/relief/nodes).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/scene/keys.h"

namespace strata::scene {

inline constexpr std::size_t kMostReliefTerms = 64;

// The kinds of terms, by their names in scene files.
std::span<const std::string_view> relief_types();

// What a kind of term is, in a few words.
std::string_view relief_meaning(const noise::ReliefTerm& term);

// Whether the term is one of height fields alone.
bool is_plane_only(const noise::ReliefTerm& term);

// A term of one kind with its defaults; type is an index of relief_types().
noise::ReliefTerm default_relief_term(std::size_t type);

// The keys of a term, as section `relief.NAME`. The fields point into the term.
Section describe_relief_term(noise::ReliefTerm& term);

// What is wrong with term i seen from those before it: its name, keys that do not fit one another, or what it is `of`.
// Empty: nothing.
std::string relief_problem(std::span<const noise::ReliefTerm> terms, std::size_t i);

}  // namespace strata::scene
