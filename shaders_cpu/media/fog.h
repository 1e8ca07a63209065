// Fog that lies low: exp(-(y - level) / fall) as dense as at its level, whose top a noise lifts and lowers, so that it
// fills one valley and leaves the next. It is lit evenly: by the whole sky, and by the sun less what mountains out of
// the picture take; it takes no light from the ground, and hills throw no shadow into it.
//
//   visibility_m  in the fog at its level: distance at which 2 % of the contrast is left; 0: no fog   0
//   level_m       height of the fog over the surface's y = 0                                          0
//   fall_m        height over which it thins to 1/e                                                   50
//   rise_m        how far the noise lifts and lowers it, about                                        0
//   patch_m       length of the noise's largest waves                                                 4000
//   forward       mean cosine of scattering (Henyey and Greenstein 1941): 0 even, 1 straight on       0.6
//
//   [scale]
//   metres = 100.0
//   [fog]
//   visibility_m = 2500.0
//   level_m = 150.0
//   fall_m = 140.0
//   rise_m = 80.0
//   patch_m = 4000.0
//   forward = 0.6
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "noise/fbm.h"
#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/media/haze.h"
#include "shaders_cpu/medium_ray.h"
#include "shaders_cpu/medium_segment.h"

namespace strata::shaders {

class Fog {
  public:
    // It stands before the sky, too.
    static constexpr bool kBeforeBackground = true;

    static bool is_in(const scene::Scene& scene) { return scene.fog.visibility_m > 0.0; }

    explicit Fog(const ShaderInputs& inputs);

    MediumSegment along(const MediumRay& ray) const;

    // Optical depth of a ray: the exact integral of the density for even fog. Where a noise lifts it, of kPieces pieces
    // of the stretch on which the noise matters, each with the level at its middle.
    double depth(const MediumRay& ray) const;

  private:
    static constexpr std::size_t kPieces = 8;

    struct Piece {
        double begin, length;  // metres from the eye
        bool is_lifted;
    };
    std::array<Piece, kPieces + 2> pieces(const MediumRay& ray) const;
    double depth_of(const MediumRay& ray, const Piece& piece) const;
    double even_depth(double y, double climb, double length, double level) const;
    double lift(const glm::dvec3& x, double step) const;
    glm::vec3 source(const MediumRay& ray) const;
    MediumSegment air(const MediumRay& ray, double distance) const;

    scene::Fog fog_;
    double metres_, density_;  // density at the level, 1/m
    std::vector<noise::Octave> waves_;
    glm::dvec3 to_sun_;
    const DaylightScene* daylight_;  // null: lights are chosen
    std::optional<Haze> haze_;
    glm::vec3 sun_, sky_;  // chosen lights: radiance of white that faces the sun; mean radiance about
};

}  // namespace strata::shaders
