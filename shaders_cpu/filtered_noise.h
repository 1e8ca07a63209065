// Sums of octaves of noise in space as a sample sees them that covers some ground: octaves that are too fine for it
// fade out of the value, and come back as the variance that is left inside of what the sample sees.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "noise/fbm.h"
#include "shaders_cpu/soft_range.h"

namespace strata::shaders {

struct FilteredValue {
    double value = 0.0;     // of what the sample can tell
    double variance = 0.0;  // of what is finer, in [0,1]
};

// Means over space of the 3-D noise: its square and its gradient's square, per lattice cell. Found by 6e6 random
// points, to 1 part in 1000; held by tests/shaders/test_filtered_noise.cpp.
inline constexpr double kMeanNoise2 = 0.0729;
inline constexpr double kMeanGradient2 = 1.489;

// An octave's waves are about two cells long, and few are shorter than one. Pixels up to half a cell can show them all,
// by the sampling theorem, and the octave is whole; for pixels of a cell it is gone.
inline constexpr double kWholeBelow = 0.5, kGoneFrom = 1.0;

// As much of an octave as pixels of so many of its cells show, in [0,1].
inline double whole_share(double cells) {
    return 1.0 - cubic_step((cells - kWholeBelow) / (kGoneFrom - kWholeBelow) - 0.5);
}

struct FilteredNoiseParameters {
    int octaves;  // each twice as fine as the one before
    double gain;
    std::uint64_t seed;
};

class FilteredNoise {
  public:
    explicit FilteredNoise(const FilteredNoiseParameters& parameters);

    // At p, in cells of the coarsest octave, |p| times the finest octave below 2^50; footprint: side of what a sample
    // sees, in the same cells. With footprint 0 the value has mean 0 and mean square 1 over space.
    FilteredValue operator()(const glm::dvec3& p, double footprint) const;

    // |value| is less.
    double most() const { return most_; }

  private:
    std::vector<noise::Octave> octaves_;
    double most_;
};

}  // namespace strata::shaders
