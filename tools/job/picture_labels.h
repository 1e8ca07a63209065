// What tells pictures apart, in words short enough to stand over them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace strata::tools::job {

// A label for each picture, from the scenes that they were rendered from: the keys in which these differ, "N = 2,
// m = 4", or estimator, N and m where they do not differ. Where a scene is not known, or its label would be another's
// too, its name is the label.
std::vector<std::string> labels_of(const std::vector<std::optional<scene::Scene>>& scenes,
                                   const std::vector<std::string>& names);

}  // namespace strata::tools::job
