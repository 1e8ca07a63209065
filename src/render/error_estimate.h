// How far a picture of several passes is from the picture that they tend to, told from the passes themselves.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "src/film/film.h"
#include "src/render/pass_sum.h"

namespace strata::render {

// The root-mean-square error of this very picture, over all pixels and channels, in linear radiance before it is
// rounded for a file, against what infinitely many passes give: the filtered picture of the surface as the tracer
// finds it. Chance and bias are both in it. The error exceeds `high` at most once in twenty times and falls short of
// `low` as often, whether passes ended by their number or by `high` being low enough; high is infinite while there is
// but one pair of passes. `bias` is the part that does not average out from run to run: estimated from above, for it
// holds the noise of its own estimate.
struct ErrorEstimate {
    double rmse = 0;
    double low = 0;
    double high = 0;
    double bias = 0;
};

// Each pair of passes a, b gives an estimate of the variance s^2 that one pass adds to the picture: the mean of d^2 / 2
// over the picture, where d is the difference of their pixels - or, where weights are random, of their jackknife
// pseudo-values K R - (K - 1) R_a, R being the ratio of the sums of all K passes so far and R_a that without a. With
// equal weights the two are the same. K passes err by s^2 / K.
//
// The squared error of the picture, times K, is a sum over pixels just as a pair's estimate is, of numbers distributed
// alike to first order and independent of the differences: it falls among the pairs' estimates as one more of them
// would. Hence the interval for one more of J numbers, by Student's t of J - 1 degrees of freedom: mean +- t s sqrt(1 +
// 1/J).
//
// The bias of a ratio of sums A / W is -Cov(A - R W, W) / (K E[W]^2) to first order, the moments being those of one
// pass; the covariance of a pair's differences is twice that.
class ErrorMeter {
  public:
    // What pairs of passes have added up to.
    struct State {
        int pairs = 0;
        double mean = 0;                 // of the pairs' estimates of s^2
        double squares = 0;              // sum of their squared deviations from it
        std::vector<glm::vec4> moments;  // sums over pairs of dA dW, and of dW^2; empty: weights are alike
    };

    ErrorMeter() = default;
    explicit ErrorMeter(State state) : state_(std::move(state)) {}
    const State& state() const { return state_; }

    // Two passes, the last that went into the sum.
    void add_pair(const film::Film& a, const film::Film& b, const PassSum& sum);

    int pairs() const { return state_.pairs; }

    // Of the sum; nothing before the first pair.
    std::optional<ErrorEstimate> of(const PassSum& sum) const;

  private:
    void add_moments(const film::Film& a, const film::Film& b);
    double squared_bias(const PassSum& sum) const;

    State state_;
};

}  // namespace strata::render
