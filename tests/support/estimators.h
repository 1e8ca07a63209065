// Every estimator, for tests that hold for all of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "src/scene/estimators.h"

namespace strata::support {

inline constexpr auto kAllEstimators = [] {
    std::array<scene::EstimatorKind, scene::all_estimators().size()> kinds;
    for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = scene::all_estimators()[i].kind;
    return kinds;
}();

// The estimator that a number falls on.
constexpr scene::EstimatorKind any_estimator(std::uint64_t number) {
    return kAllEstimators[number % kAllEstimators.size()];
}

// Those of which a predicate of their rows holds.
template <class Predicate>
std::vector<scene::EstimatorKind> estimators_where(Predicate predicate) {
    std::vector<scene::EstimatorKind> kinds;
    for (const scene::EstimatorRow& row : scene::all_estimators()) {
        if (std::invoke(predicate, row)) kinds.push_back(row.kind);
    }
    return kinds;
}

}  // namespace strata::support
