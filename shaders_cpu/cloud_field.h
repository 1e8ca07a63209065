// How deep a layer of clouds is at each place of the plan: a noise, and where it is over a threshold there is cloud.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "noise/fbm.h"
#include "shaders_cpu/filtered_noise.h"
#include "src/scene/clouds.h"

namespace strata::shaders {

class CloudField {
  public:
    explicit CloudField(const scene::CloudLayer& layer);

    // The noise over the threshold, in `edge`s, at a place in metres, and how it varies within a footprint (metres).
    // Where it is below 0 there is no cloud.
    FilteredValue excess(const glm::dvec2& place, double footprint) const;

    // Of a whole layer that is seen from so far that no cloud can be told from another.
    FilteredValue mean_excess() const { return {-threshold_, variance_}; }

    // Optical depth, straight through the layer.
    double depth(double excess) const;
    double depth_at(const glm::dvec2& place) const { return depth(excess(place, 0.0).value); }

    // The threshold is the noise's quantile among kPlaces places that are drawn evenly and independently from 2^20 x
    // 2^20 cells. The share of the plan over it is then the coverage, but for an error of which Dvoretzky, Kiefer and
    // Wolfowitz's inequality, with Massart's constant (1990), says that it exceeds e with a probability below
    // 2 exp(-2 kPlaces e^2): for kCoverageError 4.3e-9.
    static constexpr std::size_t kPlaces = 1 << 16;
    static constexpr double kCoverageError = 0.0123;

  private:
    struct Turned {
        noise::Octave octave;
        double c, s;  // cosine and sine of the turn of its lattice
    };
    glm::dvec2 in_cells(const glm::dvec2& place) const;
    double octave_at(const Turned& turned, const glm::dvec2& p) const;
    double noise_at(const glm::dvec2& cells) const;
    glm::dvec2 warped(const glm::dvec2& cells) const;

    glm::dvec2 along_;     // the direction of the streaks
    glm::dvec2 cells_;     // a metre, along it and across
    double warp_, depth_;  // warp in cells
    std::vector<Turned> octaves_;
    std::array<noise::Octave, 2> warps_;
    double edge_ = 1.0;       // in the noise's own values
    double threshold_ = 0.0;  // in edges
    double variance_ = 0.0;   // of the whole noise, in squared edges
    double share_ = 0.0;      // of the variance, of an octave of amplitude 1
};

}  // namespace strata::shaders
