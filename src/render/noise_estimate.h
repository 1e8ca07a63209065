// How noisy an average of independent renders is, told from their differences.
#pragma once

#include <optional>

#include "src/render/film.h"

namespace strata::render {

// The root-mean-square error of an average of renders that is due to chance, over all pixels and channels, in linear
// radiance. A bias that every render shares - of order 1/N^2 in estimators with normalised weights - does not show in
// differences and is not in it. low and high are the ends of the 90 % confidence interval: the true value exceeds
// `high` once in twenty times. high is infinite while there is but one pair.
struct NoiseEstimate {
    double rmse = 0;
    double low = 0;
    double high = 0;
};

// Two renders a, b of one picture with independent samples of variance s^2 differ by d with E[d^2] = 2 s^2, and K of
// them average to an error of s^2 / K. Each pair gives an unbiased estimate of s^2, the mean of d^2 / 2 over the
// picture; pairs are independent of each other, so their spread gives the interval, by Student's t.
class NoiseMeter {
  public:
    // Two complete films of one window.
    void add_pair(const Film& a, const Film& b);

    int pairs() const { return pairs_; }

    // Of the average of `passes` such renders; nothing before the first pair.
    std::optional<NoiseEstimate> of_average(int passes) const;

  private:
    int pairs_ = 0;
    double mean_ = 0;     // of the pairs' estimates of s^2
    double squares_ = 0;  // sum of their squared deviations from it
};

}  // namespace strata::render
