#include "src/render/error_estimate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "src/render/confidence.h"

namespace strata::render {

namespace {

// Of one look at a normal number. What is stated is 95 %: a render that looks after each pair and stops at the first
// bound below its target errs more often than at one look, and where most of the error is in few bright pixels its
// square is skewed. At 0.95 the bound held in 86 to 97 of 100 runs (tests/render/test_stated_error.cpp), so failures
// were up to 2.5 times as many as told: hence 1 - 0.05 / 2.5.
constexpr double kOneSidedConfidence = 0.98;

glm::dvec3 difference(const film::Film& a, const film::Film& b, const PassSum& sum, std::size_t pixel) {
    if (!sum.weighted()) return glm::dvec3(a.pixels()[pixel]) - glm::dvec3(b.pixels()[pixel]);
    return (sum.passes() - 1.0) * (sum.mean_without(b, a, pixel) - sum.mean_without(a, b, pixel));
}

}  // namespace

void ErrorMeter::add_pair(const film::Film& a, const film::Film& b, const PassSum& sum) {
    assert(a.window() == b.window() && a.complete() && b.complete() && sum.passes() >= 2);
    double squares = 0;
    for (std::size_t i = 0; i < sum.pixels(); ++i) {
        const glm::dvec3 d = difference(a, b, sum, i);
        squares += glm::dot(d, d);
    }
    const double variance = squares / (2 * 3 * static_cast<double>(sum.pixels()));
    ++pairs_;
    const double deviation = variance - mean_;
    mean_ += deviation / pairs_;
    squares_ += deviation * (variance - mean_);
    if (sum.weighted()) add_moments(a, b);
}

void ErrorMeter::add_moments(const film::Film& a, const film::Film& b) {
    moments_.resize(a.pixels().size(), glm::vec4(0));
    for (std::size_t i = 0; i < moments_.size(); ++i) {
        const double weight_a = a.weights()[i], weight_b = b.weights()[i];
        const double d_weight = weight_a - weight_b;
        const glm::dvec3 d_sum = weight_a * glm::dvec3(a.pixels()[i]) - weight_b * glm::dvec3(b.pixels()[i]);
        moments_[i] += glm::vec4(glm::dvec4(d_sum * d_weight, d_weight * d_weight));
    }
}

double ErrorMeter::squared_bias(const PassSum& sum) const {
    double squares = 0;
    for (std::size_t i = 0; i < moments_.size(); ++i) {
        const glm::dvec4 moments(moments_[i]);
        const double weight = sum.mean_weight(i);
        const double scale = 2.0 * pairs_ * sum.passes() * weight * weight;
        if (!(scale > 0)) continue;  // weights that vanish are all alike
        const glm::dvec3 bias = (sum.mean(i) * moments.w - glm::dvec3(moments)) / scale;
        squares += glm::dot(bias, bias);
    }
    return squares / (3 * static_cast<double>(sum.pixels()));
}

std::optional<ErrorEstimate> ErrorMeter::of(const PassSum& sum) const {
    if (pairs_ == 0) return std::nullopt;
    const double passes = sum.passes(), bias = squared_bias(sum);
    ErrorEstimate estimate{std::sqrt(mean_ / passes + bias), 0, std::numeric_limits<double>::infinity(),
                           std::sqrt(bias)};
    if (pairs_ == 1) return estimate;
    const double spread = std::sqrt(squares_ / (pairs_ - 1) * (1 + 1.0 / pairs_));
    const double half_width = student_quantile(kOneSidedConfidence, pairs_ - 1) * spread;
    estimate.low = std::sqrt(std::max(0.0, mean_ - half_width) / passes);
    estimate.high = std::sqrt((mean_ + half_width) / passes + bias);
    return estimate;
}

}  // namespace strata::render
