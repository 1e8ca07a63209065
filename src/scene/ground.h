// The ground's layers, [[ground]] in a scene file: plain values. ground_keys.cpp documents every one.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "src/scene/ground_palette.h"

namespace strata::scene {

// Where a layer lies along one quantity: all over [from, to], ending over `edge`, half gone at the ends themselves. An
// end at the end of what is allowed is none.
struct SoftRange {
    double from;
    double to;
    double edge;
};

inline constexpr double kEndOfHeights = 1e9;  // surface units
inline constexpr double kEndOfNoise = 100.0;

// Sums of octaves of noise in space, of mean 0 and root mean square 1.
struct GroundNoise {
    double size = 1.0;     // of the coarsest octave's cells, surface units
    double stretch = 1.0;  // how much longer along y
    int octaves = 5;
    double gain = 0.55;
    std::uint64_t seed = 1;
};

struct GroundStrata {
    double thickness = 0.1;  // of the coarsest beds, surface units
    double length = 10.0;    // over which beds go on, surface units
    int octaves = 3;
    double gain = 0.7;
    double warp = 0.0;       // how far beds go up and down, surface units
    double warp_size = 1.0;  // over which they do, surface units
    std::uint64_t seed = 1;
};

struct GroundLayer {
    std::string name;

    GroundKind kind = GroundKind::own;
    glm::dvec3 colour{0.2};
    double tone = 0.0;  // largest share of the second colour
    GroundKind second = GroundKind::own;
    glm::dvec3 second_colour{0.2};
    GroundNoise tone_noise{};
    double roughness = 0.0;

    double cover = 1.0;
    SoftRange height{-kEndOfHeights, kEndOfHeights, 0.1};
    double height_noise = 0.0;  // surface units
    SoftRange slope_deg{0.0, 180.0, 5.0};
    double slope_noise_deg = 0.0;
    glm::dvec3 aspect{0.0, 0.0, 1.0};
    SoftRange facing{-1.0, 1.0, 0.2};
    SoftRange patches{-kEndOfNoise, kEndOfNoise, 0.5};
    GroundNoise noise{};
    SoftRange beds{-kEndOfNoise, kEndOfNoise, 0.3};
    GroundStrata strata{};
};

inline std::vector<std::string> names_of(std::span<const GroundLayer> layers) {
    std::vector<std::string> names;
    for (const GroundLayer& layer : layers) names.push_back(layer.name);
    return names;
}

}  // namespace strata::scene
