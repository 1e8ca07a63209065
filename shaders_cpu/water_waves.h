// The waves of level water as slopes: those that a sample can tell by a noise, all finer ones as a Gaussian about it,
// of which a sample sees one facet. Heights stay 0, so that the shore is where the ground is at the level.
//
// Slopes' mean square by the wind is that of C. Cox and W. Munk, "Measurement of the roughness of the sea surface from
// photographs of the sun's glitter", J. Opt. Soc. Am. 44, 1954: 0.003 + 0.00512 w, w in m/s. Below 1 m/s, where wind
// raises no ripples of its own, it is taken to fall off with the wind's square.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "noise/fbm.h"

namespace strata::shaders {

// Along x and z: the mean, and the variance along each axis of what is finer.
struct WaveSlopes {
    glm::dvec2 mean{0.0};
    double variance = 0.0;
};

// Of both axes together.
double mean_square_slope(double wind_m_s);

// The normal of a face with these slopes, upward, of unit length.
inline glm::dvec3 normal_of_slope(const glm::dvec2& slope) {
    return glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
}

class WaterWaves {
  public:
    // cell: of the longest waves, a wavelength being two, in surface units.
    WaterWaves(double wind_m_s, double longest);

    bool is_calm() const { return octaves_.empty(); }

    // At a place of the level, for a sample that sees a square of side `footprint` of it; surface units.
    WaveSlopes at(const glm::dvec3& x, double footprint) const;

    // Of ripples finer than all octaves, along each axis: `variance` is never less.
    double finest_variance() const { return finest_variance_; }

  private:
    std::vector<noise::Octave> octaves_;
    std::vector<glm::dvec2> turns_;  // cosine and sine of each octave's axes
    double octave_variance_ = 0.0, finest_variance_ = 0.0;
};

// The facets that an eye sees of slopes with a Gaussian distribution: each counts by its area across the eye's
// direction.
class VisibleFacets {
  public:
    // to_eye: of unit length, y > 0.
    VisibleFacets(const WaveSlopes& slopes, const glm::dvec3& to_eye);

    // A facet's slope from two even numbers in (0,1), by that density.
    glm::dvec2 draw(double u, double v) const;

    // Area across the eye's direction of the facets over a unit of the level: > 0.
    double area() const { return area_; }

    // Share of the level, a unit of slopes' plane, whose facets have a slope.
    double density(const glm::dvec2& slope) const;

  private:
    WaveSlopes slopes_;
    glm::dvec2 to_eye_;  // level part, of unit length
    double most_ = 0.0;  // in deviations, of the slope towards the eye: steeper facets are turned away
    double area_ = 0.0;
};

// A beam as waves mirror it that would mirror all of it: radiance towards the eye over the irradiance across the beam,
// as all the facets together send it, so that no single one glares. to_light, to_eye: of unit length; radius: of the
// disc that the beam comes from, which widens its image and whose radiance is the most there is; 0: a point.
// Its integral over all directions of beams, below the level too, is 1.
double mirrored_beam(const WaveSlopes& slopes, const glm::dvec3& to_eye, const glm::dvec3& to_light, double radius);

}  // namespace strata::shaders
