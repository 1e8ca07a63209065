// Passes over one window, added up: each pixel's weighted radiance and weights, of which the picture is the ratio.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "src/film/film.h"

namespace strata::render {

// A pass whose weights are random divides one random sum by another, which errs on average: by beta / n, to first order
// in the number n of its samples. A mean of such pixels would keep that however many passes there are. Added up before
// they are divided, K passes are one pixel of K n samples: beta / (K n). Where all weights are alike this is the plain
// mean of the passes, to the last bit.
class PassSum {
  public:
    // A complete film of the same window as those before. Weights are the film's; all passes have them or none.
    void add(const film::Film& pass);

    // As another one was that had added up so many passes.
    PassSum(int passes, std::vector<glm::dvec3> sums, std::vector<double> weights)
        : passes_(passes), sum_(std::move(sums)), weight_(std::move(weights)) {}
    PassSum() = default;

    int passes() const { return passes_; }

    // Of each pixel, over the passes: weighted radiance, and weights (none: every pass counts by 1).
    std::span<const glm::dvec3> sums() const { return sum_; }
    std::span<const double> weights() const { return weight_; }

    std::size_t pixels() const { return sum_.size(); }
    bool weighted() const { return !weight_.empty(); }

    // A pixel of the passes so far.
    glm::dvec3 mean(std::size_t pixel) const { return sum_[pixel] / total(pixel); }

    // The mean weight that a pass has in a pixel.
    double mean_weight(std::size_t pixel) const { return total(pixel) / passes_; }

    // A pixel of all passes but `pass`, which has been added; of `other` instead where all others together weigh
    // next to nothing.
    glm::dvec3 mean_without(const film::Film& pass, const film::Film& other, std::size_t pixel) const;

  private:
    double total(std::size_t pixel) const { return weight_.empty() ? passes_ : weight_[pixel]; }

    int passes_ = 0;
    std::vector<glm::dvec3> sum_;
    std::vector<double> weight_;  // empty: every pass counts by 1
};

}  // namespace strata::render
