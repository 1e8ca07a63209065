#include "shaders_cpu/cloud_field.h"

#include <algorithm>
#include <cmath>

#include "noise/reference.h"
#include "src/sample/counter_hash.h"

namespace strata::shaders {

namespace {

// Cosine and sine of the turn from one octave's lattice to the next: 36.87 degrees, after which lattices never line up.
constexpr double kTurnCosine = 0.8, kTurnSine = 0.6;
// Octave 0 of the warp is as coarse as this, in cells of the clouds' own.
constexpr double kWarpCells = 1.3;

std::vector<noise::Octave> cloud_octaves(const scene::CloudLayer& layer) {
    return noise::make_octaves({.octaves = layer.octaves,
                                .lacunarity = 2.0,
                                .gain = layer.gain,
                                .amplitude = 1.0,
                                .frequency = 1.0,
                                .seed = layer.seed});
}

double plane_noise(const noise::Octave& octave, const glm::dvec2& p) {
    const noise::Point<2> at = noise::octave_position<2>(octave, {p.x, p.y});
    return noise::reference_value<2>(octave.key, noise::split_position<2>(at));
}

glm::dvec2 random_place(std::uint64_t seed, std::size_t i) {
    constexpr double kCells = 0x1p20;
    const std::uint64_t hash = sample::counter_hash(sample::cell_key(seed, 0, 0), i);
    return kCells * 0x1p-32 * glm::dvec2(sample::high_word(hash), sample::low_word(hash));
}

}  // namespace

CloudField::CloudField(const scene::CloudLayer& layer)
    : along_(std::cos(glm::radians(layer.stretch_deg)), std::sin(glm::radians(layer.stretch_deg))),
      cells_(1.0 / (layer.size_m * layer.stretch), 1.0 / layer.size_m),
      warp_(layer.warp_m / layer.size_m),
      depth_(layer.depth) {
    double c = 1.0, s = 0.0, amplitudes2 = 0.0;
    for (const noise::Octave& octave : cloud_octaves(layer)) {
        octaves_.push_back({octave, c, s});
        amplitudes2 += octave.amplitude * octave.amplitude;
        const double turned = kTurnCosine * c - kTurnSine * s;
        s = kTurnSine * c + kTurnCosine * s;
        c = turned;
    }
    const std::vector<noise::Octave> warps = noise::make_octaves(
        {.octaves = 2, .lacunarity = 1.0, .amplitude = 1.0, .frequency = 1.0 / kWarpCells, .seed = layer.seed + 1});
    std::ranges::copy(warps, warps_.begin());

    std::vector<double> values(kPlaces);
    for (std::size_t i = 0; i < kPlaces; ++i) values[i] = noise_at(warped(random_place(layer.seed, i)));
    double squares = 0.0;
    for (const double value : values) squares += value * value;
    squares /= static_cast<double>(kPlaces);
    edge_ = layer.edge * std::sqrt(squares);
    variance_ = squares / (edge_ * edge_);
    share_ = variance_ / amplitudes2;
    const auto rank = static_cast<std::ptrdiff_t>((1.0 - layer.coverage) * static_cast<double>(kPlaces - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    threshold_ = values[static_cast<std::size_t>(rank)] / edge_;
}

glm::dvec2 CloudField::in_cells(const glm::dvec2& place) const {
    const double along = glm::dot(place, along_), across = along_.x * place.y - along_.y * place.x;
    return {along * cells_.x, across * cells_.y};
}

glm::dvec2 CloudField::warped(const glm::dvec2& cells) const {
    if (warp_ == 0.0) return cells;
    return cells + warp_ * glm::dvec2(plane_noise(warps_[0], cells), plane_noise(warps_[1], cells));
}

double CloudField::octave_at(const Turned& turned, const glm::dvec2& p) const {
    return turned.octave.amplitude *
           plane_noise(turned.octave, {turned.c * p.x - turned.s * p.y, turned.s * p.x + turned.c * p.y});
}

double CloudField::noise_at(const glm::dvec2& cells) const {
    double sum = 0.0;
    for (const Turned& turned : octaves_) sum += octave_at(turned, cells);
    return sum;
}

FilteredValue CloudField::excess(const glm::dvec2& place, double footprint) const {
    const glm::dvec2 cells = warped(in_cells(place));
    const double seen = footprint * std::max(cells_.x, cells_.y);
    FilteredValue sum;
    for (const Turned& turned : octaves_) {
        const double shown = whole_share(turned.octave.frequency * seen), amplitude = turned.octave.amplitude;
        if (shown > 0.0) sum.value += shown * octave_at(turned, cells);
        sum.variance += share_ * amplitude * amplitude * (1.0 - shown * shown);
    }
    sum.value = sum.value / edge_ - threshold_;
    return sum;
}

// Thin at the rim, depth_ at 1, and less and less more beyond: a flat rise at first would leave rims that nobody sees,
// a steep one throughout a base as black as ink.
double CloudField::depth(double excess) const {
    if (excess <= 0.0) return 0.0;
    constexpr double kAtOne = 0.5 * (0.15 + 2.0);
    return depth_ / kAtOne * excess * (0.15 + 2.0 * excess) / (1.0 + excess * excess);
}

}  // namespace strata::shaders
