// From the channels of samples to those of a pixel, by each channel's filter.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "src/estimate/estimator.h"

namespace strata::estimate {

// Whether an estimator's samples tell what a filter asks for. All do but of the variance, which takes two samples or
// more that count alike: of `random`, whose samples are independent, the estimate is unbiased. Of `stratified` it is an
// upper bound on average: with one sample in each of n equally likely strata whose means are a_i and variances s_i^2,
// the mean has the variance S / n, S being the mean of s_i^2, and the estimate is on average S / n plus
// sum (a_i - a)^2 / (n (n - 1)). Points of sobol and weighted or shared samples depend on each other in ways that their
// values in one pixel do not tell.
bool has_filter(const EstimatorSettings& settings, integrate::ChannelFilter filter);

// The samples that are placed for one pixel.
struct PixelSamples {
    glm::ivec2 pixel;
    std::span<const double> u, v;    // px in the frame
    std::span<const double> weight;  // empty: all alike
    std::span<const float> values;   // ChannelSet::values() a sample
};

// Sets the pixel's values of the channels whose filter is neither `picture` nor `ranks`. A value depends on the samples
// in their order alone: not on tiles, crop or threads.
void filter_own(const integrate::ChannelSet& channels, const PixelSamples& samples, std::span<float> pixel);

// Sets those that are: sums by the samples' weights, in double, as equations (2) and (3) have it.
void filter_weighted(const integrate::ChannelSet& channels, const PixelSamples& samples, std::span<float> pixel);

// Of those whose filter is `ranks`, from the weighted values to what the pixel holds.
void order_ranks(const integrate::ChannelSet& channels, std::span<float> pixel);

}  // namespace strata::estimate
