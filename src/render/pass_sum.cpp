#include "src/render/pass_sum.h"

#include <cassert>

namespace strata::render {

void PassSum::add(const film::Film& pass) {
    assert(pass.complete() && (passes_ == 0 || pass.pixels().size() == sum_.size()));
    if (passes_ == 0) {
        sum_.assign(pass.pixels().size(), glm::dvec3(0.0));
        weight_.assign(pass.weights().size(), 0.0);
    }
    ++passes_;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        const glm::dvec3 radiance(pass.pixels()[i]);
        sum_[i] += weighted() ? pass.weights()[i] * radiance : radiance;
        if (weighted()) weight_[i] += pass.weights()[i];
    }
}

glm::dvec3 PassSum::mean_without(const film::Film& pass, const film::Film& other, std::size_t pixel) const {
    // Below this share the difference of two sums holds no digit that could be relied on.
    constexpr double kLeastShare = 1e-9;
    const double weight = weighted() ? pass.weights()[pixel] : 1.0;
    const double rest = total(pixel) - weight;
    if (!(rest > kLeastShare * total(pixel))) return glm::dvec3(other.pixels()[pixel]);
    return (sum_[pixel] - weight * glm::dvec3(pass.pixels()[pixel])) / rest;
}

}  // namespace strata::render
