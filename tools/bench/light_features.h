// What each part of a still's light costs: pairs of scenes that differ in it alone.
#pragma once

#include <string>
#include <vector>

#include "tools/bench/variants.h"

namespace strata::tools::bench {

struct LightFeature {
    std::string name;
    Variant off, on;
};

// Of a landscape of a few kilometres on the Earth.
std::vector<LightFeature> light_features();

}  // namespace strata::tools::bench
