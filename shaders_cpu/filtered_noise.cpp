#include "shaders_cpu/filtered_noise.h"

#include <algorithm>
#include <cmath>

#include "noise/bounds.h"
#include "noise/reference.h"

namespace strata::shaders {

namespace {

constexpr double kLacunarity = 2.0;

// Octaves have keys and offsets of their own, so that their variances add up.
double amplitude_for_variance_1(const FilteredNoiseParameters& p) {
    double sum = 0.0, amplitude2 = 1.0;
    for (int k = 0; k < p.octaves; ++k, amplitude2 *= p.gain * p.gain) sum += amplitude2;
    return 1.0 / std::sqrt(kMeanNoise2 * sum);
}

// Of an octave of amplitude 1 along a stretch of so many cells: its slope times the stretch's own variance, 1/12 of its
// square, as long as that is less than all.
double variance_within(double cells) { return std::min(kMeanGradient2 / 3.0 * cells * cells / 12.0, kMeanNoise2); }

}  // namespace

FilteredNoise::FilteredNoise(const FilteredNoiseParameters& parameters)
    : octaves_(noise::make_octaves({.octaves = parameters.octaves,
                                    .lacunarity = kLacunarity,
                                    .gain = parameters.gain,
                                    .amplitude = amplitude_for_variance_1(parameters),
                                    .frequency = 1.0,
                                    .seed = parameters.seed})),
      most_(0.0) {
    for (const noise::Octave& octave : octaves_) most_ += octave.amplitude * noise::kBounds3.value;
}

FilteredValue FilteredNoise::operator()(const glm::dvec3& p, double footprint) const {
    FilteredValue sum;
    for (const noise::Octave& octave : octaves_) {
        const double cells = octave.frequency * footprint;
        const double share = whole_share(cells), amplitude2 = octave.amplitude * octave.amplitude;
        if (share > 0.0) {
            const noise::Point<3> at = noise::octave_position<3>(octave, {p.x, p.y, p.z});
            sum.value += share * octave.amplitude * noise::reference_value<3>(octave.key, noise::split_position<3>(at));
        }
        sum.variance += amplitude2 * ((1.0 - share * share) * kMeanNoise2 + share * share * variance_within(cells));
    }
    sum.variance = std::min(sum.variance, 1.0);
    return sum;
}

}  // namespace strata::shaders
