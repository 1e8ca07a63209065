// The kinds of relief terms, for `strata scenes --relief`.
#pragma once

#include <string>

namespace strata::tools::scene_list {

// A paragraph a kind: what it is, what it takes, its keys with defaults, units and ranges, and what bounds it has with
// its defaults over default hills.
std::string relief_list();

}  // namespace strata::tools::scene_list
