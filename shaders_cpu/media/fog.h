// Fog that lies low: exp(-(y - level) / fall) as dense as at its level, whose top a noise lifts and lowers, so that it
// fills one valley and leaves the next. It is lit evenly: by the whole sky, and by the sun less what mountains out of
// picture take; it takes no light from the ground, and hills throw no shadow into it unless it has shafts: then a ray
// to the sun from one place of each sample's way, drawn by where the fog scatters, says whether its light arrives
// there.
//
//   visibility_m  in the fog at its level: distance at which 2 % of the contrast is left; 0: no fog   0
//   level_m       height of the fog over the surface's y = 0                                          0
//   fall_m        height over which it thins to 1/e                                                   50
//   rise_m        how far the noise lifts and lowers it, about                                        0
//   patch_m       length of the noise's largest waves                                                 4000
//   forward       mean cosine of scattering (Henyey and Greenstein 1941): 0 even, 1 straight on       0.6
//   shafts        whether ground and clouds throw their shadows into it                               false
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
//   shafts = true
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
    static constexpr auto kName = "fog";
    // It stands before the sky, too.
    static constexpr bool kBeforeBackground = true;

    static bool is_in(const scene::Scene& scene) { return scene.fog.visibility_m > 0.0; }

    static const char* why(const scene::Scene& scene) {
        return is_in(scene) ? "lies low, by fog.visibility_m and fog.level_m" : "fog.visibility_m is 0: no fog";
    }

    explicit Fog(const ShaderInputs& inputs);

    MediumSegment along(const MediumRay& ray) const;

    // Whether the sun's part of what the fog adds is not its own affair, but found by a shadow ray from shaft().way.
    bool has_shafts() const { return fog_.shafts; }

    struct Shaft {
        double way = 0.0;  // from the eye, surface units
        glm::vec3 sunlight{
            0.0f};  // what the eye would see of the sun in the fog if all of it were lit as this place is
    };

    // A place where light is scattered on its way along a ray, by the density transmittance * extinction, from u in
    // [0,1): the mean of sunlight where the sun is seen, and of nothing elsewhere, is what the eye sees.
    Shaft shaft(const MediumRay& ray, double u) const;

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
    double way_within(double climb, const Piece& piece, double share) const;
    float phase(const glm::dvec3& direction) const;
    glm::vec3 sun_at(const glm::dvec3& x, double height) const;
    glm::vec3 sun_source(const MediumRay& ray) const;
    glm::vec3 sky_source() const;
    MediumSegment air(const MediumRay& ray, double distance) const;

    scene::Fog fog_;
    double metres_, density_;  // density at the level, 1/m
    std::vector<noise::Octave> waves_;
    glm::dvec3 to_sun_;
    const DaylightScene* daylight_;  // null: lights are chosen
    const CloudScene* clouds_;       // null: none
    std::optional<Haze> haze_;
    glm::vec3 sun_, sky_;  // chosen lights: radiance of white that faces the sun; mean radiance about
};

}  // namespace strata::shaders
