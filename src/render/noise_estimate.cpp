#include "src/render/noise_estimate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "src/render/confidence.h"

namespace strata::render {

namespace {

constexpr double kOneSidedConfidence = 0.95;

}  // namespace

void NoiseMeter::add_pair(const Film& a, const Film& b) {
    assert(a.window() == b.window() && a.complete() && b.complete());
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const glm::dvec3 difference = glm::dvec3(a.pixels()[i]) - glm::dvec3(b.pixels()[i]);
        sum += glm::dot(difference, difference);
    }
    const double variance = sum / (2 * 3 * static_cast<double>(a.pixels().size()));
    ++pairs_;
    const double deviation = variance - mean_;
    mean_ += deviation / pairs_;
    squares_ += deviation * (variance - mean_);
}

std::optional<NoiseEstimate> NoiseMeter::of_average(int passes) const {
    assert(passes >= 1);
    if (pairs_ == 0) return std::nullopt;
    NoiseEstimate estimate{std::sqrt(mean_ / passes), 0, std::numeric_limits<double>::infinity()};
    if (pairs_ == 1) return estimate;
    const double standard_error = std::sqrt(squares_ / (pairs_ - 1) / pairs_);
    const double half_width = student_quantile(kOneSidedConfidence, pairs_ - 1) * standard_error;
    estimate.low = std::sqrt(std::max(0.0, mean_ - half_width) / passes);
    estimate.high = std::sqrt((mean_ + half_width) / passes);
    return estimate;
}

}  // namespace strata::render
