// Where a layer of ground lies ([[ground]] in a scene file): the product of its soft ranges over height, slope, the
// way it faces, a noise and beds. Curvature is no part of it: the normal has the surface's first derivatives alone,
// and second ones of all octaves would cost each hit about as much again as its normal does.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "shaders_cpu/filtered_noise.h"
#include "shaders_cpu/soft_range.h"
#include "src/scene/ground.h"

namespace strata::shaders {

// What masks look at. Surface units.
struct GroundPoint {
    glm::dvec3 x;       // where noise is read
    glm::dvec3 normal;  // outward, of unit length
    glm::dvec3 up;      // away from the base plane or sphere, of unit length
    double height;
    double slope_deg;
    double footprint;  // ShadingPoint
};

// A noise with its cells' sizes in surface units.
class GroundTexture {
  public:
    explicit GroundTexture(const scene::GroundNoise& noise);

    FilteredValue at(const GroundPoint& point) const { return noise_(point.x * cells_, point.footprint * finest_); }
    double most() const { return noise_.most(); }

  private:
    glm::dvec3 cells_;  // a surface unit along each axis
    double finest_;     // the most of them
    FilteredNoise noise_;
};

// A noise along height, which changes slowly across.
class GroundBeds {
  public:
    explicit GroundBeds(const scene::GroundStrata& strata);

    FilteredValue at(const GroundPoint& point) const;

  private:
    scene::GroundStrata strata_;
    double finest_;  // cells a surface unit
    FilteredNoise beds_, warp_;
};

class GroundMask {
  public:
    explicit GroundMask(const scene::GroundLayer& layer);

    // The layer's share, in [0, cover].
    double operator()(const GroundPoint& point) const;

  private:
    double facing_share(const GroundPoint& point) const;
    double noisy_share(const GroundPoint& point) const;

    double cover_;
    SmoothRange height_, slope_, facing_, patches_, beds_range_;
    double height_noise_, slope_noise_;
    glm::dvec3 aspect_;
    std::optional<GroundTexture> noise_;  // none where nothing is made of it
    std::optional<GroundBeds> beds_;      // likewise
};

}  // namespace strata::shaders
