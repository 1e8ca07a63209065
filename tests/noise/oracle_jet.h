// The noise's oracle and the SIMD targets to compare with it.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "noise/simd_target.h"
#include "tools/stability/oracles/noise_jet.h"

namespace strata::noise::test {

using oracle::Dual2;
using oracle::oracle_jet;
using oracle::oracle_jet_at;

// All targets, before any is pinned: a pin hides the others.
inline const std::vector<std::string>& all_targets() {
    static const std::vector<std::string> targets = simd_targets();
    return targets;
}

// Runs body(target's name) with each SIMD target that this machine has, and leaves the best one in use.
template <class Body>
void for_each_target(const Body& body) {
    const std::vector<std::string>& targets = all_targets();
    REQUIRE_FALSE(targets.empty());
    for (const std::string& target : targets) {
        REQUIRE(pin_simd_target(target));
        CAPTURE(target);
        body(target);
    }
    REQUIRE(pin_simd_target(targets.front()));
}

}  // namespace strata::noise::test
