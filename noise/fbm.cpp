#include "noise/fbm.h"

namespace strata::noise {

namespace {

double unit_offset(std::uint64_t key, std::uint64_t axis) {
    constexpr std::uint64_t kOffsetStream = 0x6F66667365740000u;
    return static_cast<double>(mix64(key ^ (kOffsetStream + axis)) >> 11) * 0x1p-53;
}

}  // namespace

std::vector<Octave> make_octaves(const FbmParameters& parameters) {
    std::vector<Octave> octaves(static_cast<std::size_t>(parameters.octaves));
    double amplitude = parameters.amplitude;
    double frequency = parameters.frequency;
    for (int k = 0; k < parameters.octaves; ++k) {
        Octave& octave = octaves[static_cast<std::size_t>(k)];
        octave.amplitude = amplitude;
        octave.frequency = frequency;
        octave.key = lattice_key(parameters.seed, k);
        const std::uint64_t key = octave_key(parameters.seed, k);
        for (std::size_t axis = 0; axis < 3; ++axis) octave.offset[axis] = unit_offset(key, axis);
        amplitude *= parameters.gain;
        frequency *= parameters.lacunarity;
    }
    return octaves;
}

std::vector<Octave> make_live_octaves(const FbmParameters& parameters) {
    std::vector<Octave> octaves = make_octaves(parameters);
    while (octaves.size() > 1 && octaves.back().amplitude == 0.0) octaves.pop_back();
    return octaves;
}

}  // namespace strata::noise
