// Estimators turn an image function into pixels: they choose where and when to sample, and with what weight. Every
// sample is a pure function of (seed, pixel or cell, index). References in parentheses are the paper's equations:
// Gamito & Maddock, "Anti-aliasing with stratified B-spline filters of arbitrary degree", CGF 25(2), 2006.
//
// What each one is: src/scene/estimators.h. Shared estimators have N x N samples in each pixel-sized cell [i,i+1) of
// the screen; a sample counts in every pixel whose support holds it, by its B-spline weight, and a pixel is divided by
// its sum of weights.
//
// All but `none` spread their samples over the shutter (18), all but `random` in strata of time. Weights are
// normalised: a constant picture is exact.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "src/estimate/estimator_weights.h"
#include "src/filter/bspline_table.h"
#include "src/integrate/image_function.h"
#include "src/sample/pattern.h"
#include "src/sample/shutter.h"
#include "src/scene/scene.h"

namespace strata::estimate {

struct EstimatorSettings {
    scene::EstimatorKind kind = scene::EstimatorKind::stratified;
    int N = 4;           // samples a side, >= 1
    int m = 4;           // order of the B-spline in space, [1,100]
    int time_order = 1;  // order of the B-spline in time, [1,100]
    std::uint64_t seed = 1;
    sample::Shutter shutter;
};

// The settings a scene asks for, its frame's time included; where nothing moves while the shutter is open, that is the
// instant in its middle. Each frame has sample positions of its own: its seed is the
// scene's mixed with the frame's number, and the scene's itself for frame 0.
EstimatorSettings estimator_settings(const scene::Scene& scene);

// The samples of several pixels or cells, one after the other; as many for each. Its memory is reused from call to
// call.
struct SampleSet {
    std::vector<double> u, v;               // px, in the frame
    std::vector<double> t;                  // seconds
    std::vector<double> weight;             // not normalised; empty: all alike
    std::vector<std::uint64_t> owner_keys;  // of each pixel or cell
    std::uint32_t samples_each = 1;
    std::vector<float> fraction_u, fraction_v;  // position in its cell; shared estimators only
    std::vector<float> scratch_q, scratch_x;    // folded probabilities and what became of them
    std::vector<std::uint32_t> scratch_permutation;

    integrate::SampleBatch batch(std::size_t first, std::size_t count) const {
        return {std::span(u).subspan(first, count),
                std::span(v).subspan(first, count),
                std::span(t).subspan(first, count),
                {owner_keys, samples_each, first}};
    }
};

// One sample as it counts in one pixel.
struct ProbeSample {
    double u = 0, v = 0;  // px, from the pixel's centre
    double time_s = 0;
    double weight = 0;  // as applied: a pixel's sum to 1
};

class Estimator {
  public:
    explicit Estimator(const EstimatorSettings& settings);

    const EstimatorSettings& settings() const { return settings_; }

    // Whether samples belong to screen cells and are shared by pixels, rather than belong to a pixel.
    bool shared() const { return row_.is_shared(); }

    // Whether samples are placed by the inverse of the filter's distribution.
    bool inverts_filter() const { return space_.has_value(); }

    // Whether samples count by B-spline weights.
    bool weighs_samples() const { return weights_.has_value(); }

    // Whether a pixel's sum of weights differs from seed to seed: what it is divided by is random then, and a mean of
    // such pixels keeps the bias of one.
    bool has_random_weights() const { return shared() || row_.placement == scene::Placement::jittered; }

    // Samples a pixel, or a cell where they are shared.
    int sample_count() const { return sample_count_; }

    // The samples of pixels, in order; not for shared estimators.
    void pixel_samples(std::span<const glm::ivec2> pixels, SampleSet& out) const;

    // The samples of screen cells [x,x+1) x [y,y+1); shared estimators only.
    void cell_samples(std::span<const glm::ivec2> cells, SampleSet& out) const;

    // How much a sample of a cell counts in the pixels around it; shared estimators only.
    const BsplineWeights& weights() const { return *weights_; }

    // Every sample with a weight other than zero in a pixel, in the order in which it is summed.
    std::vector<ProbeSample> probe_samples(int x, int y) const;

  private:
    void place_grid(std::span<const glm::ivec2> pixels, SampleSet& out) const;
    void place_jittered(std::span<const glm::ivec2> pixels, SampleSet& out) const;
    void place_by_density(std::span<const glm::ivec2> pixels, SampleSet& out) const;
    void place_times(std::span<const glm::ivec2> owners, SampleSet& out) const;
    std::uint64_t key(const glm::ivec2& owner) const;
    void name_owners(std::span<const glm::ivec2> owners, SampleSet& out) const;
    std::vector<ProbeSample> probe_shared(int x, int y) const;

    EstimatorSettings settings_;
    scene::EstimatorRow row_;
    int sample_count_;
    sample::Pattern pattern_;
    std::vector<double> grid_offset_;  // px from the pixel's centre along an axis: grids
    std::vector<double> grid_weight_;  // along an axis: a grid on the support
    std::optional<BsplineWeights> weights_;
    std::optional<filter::BsplineTable> space_;
    std::optional<filter::BsplineTable> time_;
};

}  // namespace strata::estimate
