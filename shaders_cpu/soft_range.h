// Where a layer of ground lies along one quantity, for a sample that sees a stretch of it and not a point.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/scene/ground.h"

namespace strata::shaders {

// 0 to 1 over [-1/2, 1/2], with a continuous slope.
inline double cubic_step(double x) {
    const double t = std::clamp(x + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// The slope of cubic_step(x / w) is a density, 6 t (1 - t) / w over a width w, of variance w^2 / 20. Where the quantity
// itself varies inside of what a sample sees, by a density of variance v, the mean of the step is the step smoothed by
// that density: about one whose own density has the sum of the variances, so of a width whose square is greater by
// 20 v.
inline constexpr double kEdgePerDeviation2 = 20.0;

class SmoothRange {
  public:
    // Ends that are not within (least, greatest) are none.
    SmoothRange(const scene::SoftRange& range, double least, double greatest)
        : from_(range.from <= least ? -std::numeric_limits<double>::infinity() : range.from),
          to_(range.to >= greatest ? std::numeric_limits<double>::infinity() : range.to),
          edge2_(range.edge * range.edge) {}

    bool is_everything() const { return std::isinf(from_) && std::isinf(to_); }

    // In [0,1]: the mean over a quantity of the given mean and variance. As to > from, the steps are one above the
    // other.
    double operator()(double mean, double variance) const {
        const double width = std::sqrt(edge2_ + kEdgePerDeviation2 * variance);
        return cubic_step((mean - from_) / width) - cubic_step((mean - to_) / width);
    }

    // Whether all means within `reach` of the given one have 0 for every variance up to that given.
    bool is_nothing_near(double mean, double reach, double variance) const {
        const double beyond = reach + 0.5 * std::sqrt(edge2_ + kEdgePerDeviation2 * variance);
        return mean + beyond <= from_ || mean - beyond >= to_;
    }

  private:
    double from_, to_, edge2_;
};

}  // namespace strata::shaders
