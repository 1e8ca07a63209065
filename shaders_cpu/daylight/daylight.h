// Daylight: sun, sky, twilight and the air between, of one clear atmosphere around the Earth.
//
// All is computed when a Daylight is made, in about 0.16 s, from the arguments alone: equal arguments give equal bits
// on any thread. Then it is only read, by any number of threads.
//
// Units and axes. Metres; y up; unit directions, away from the observer. Colours are linear Rec.709 whose luminance
// 0.2126 R + 0.7152 G + 0.0722 B is in cd/m^2 for radiance and in lux for irradiance: a surface of reflectance rho
// shows rho * irradiance / pi. White is D65, so a high sun is a little warm and a shadow under open sky is blue. Of the
// sun come up to 130 000 lux, and of a clear sky some 10 000 beside it; twilight at -6 degrees is 1e5 times darker, so
// an exposure belongs to the scene.
//
//   const Daylight day(Atmosphere{.visibility = 150e3}, sun_direction, eye_height);        // once a picture
//   radiance = albedo / pi * (day.sun_illuminance(height) * n_dot_sun * visible            // a surface
//                             + day.sky_irradiance(normal) + day.ground_irradiance(normal));
//   const AerialPerspective air = day.aerial_from_observer(direction, distance);           // seen from the eye
//   pixel = air.transmittance * radiance + air.inscatter;
//   pixel = day.sky_radiance(direction);                                                   // or nothing hit
//
// How right it is, by day: light scattered once within 0.2 % (rms) and twice within 1 % of brute force, colours
// within 0.005 in (u',v') of the whole spectrum, all orders together within 2 % of light paths in clear air (visibility
// 200 km) and some 10 % at 60 km, where the red of the last degree above the horizon comes out up to a half too bright.
//
// Left out: refraction (a sun on the horizon stands half a degree too low, the horizon a third of a degree), clouds,
// polarisation, the moon and stars. Below about 8 degrees under the horizon the twilight is guesswork.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shaders_cpu/daylight/aerial_table.h"
#include "shaders_cpu/daylight/air_light.h"
#include "shaders_cpu/daylight/sky_frame.h"
#include "shaders_cpu/daylight/sky_irradiance.h"
#include "shaders_cpu/daylight/sky_sampler.h"
#include "shaders_cpu/daylight/sky_table.h"

namespace strata::shaders {

// Unit vectors, one array a coordinate; equally long.
struct DirectionBatch {
    std::span<const float> x, y, z;
};

// Colours, one array a channel; equally long.
struct ColourBatch {
    std::span<float> r, g, b;
};

class Daylight {
  public:
    // `sun_direction` is a unit vector towards the sun's middle, `observer_height` in metres above the sphere, which is
    // sea level. Throws std::invalid_argument for a value out of range: heights from -1000 (taken as 0) to 100 000 m.
    Daylight(const Atmosphere& atmosphere, const glm::dvec3& sun_direction, double observer_height);

    // The sky as the observer sees it, without the sun's disc; below the horizon the lit sphere through the air.
    glm::dvec3 sky_radiance(const glm::dvec3& direction) const;
    void sky_radiance(const DirectionBatch& directions, const ColourBatch& radiance) const;

    // Sunlight on a plane that faces it, at a height in metres; fades while the disc sets behind the sphere.
    glm::dvec3 sun_illuminance(double height) const;

    // Mean radiance of the disc, whose radius is kSunRadius: illuminance / kSunSolidAngle.
    glm::dvec3 sun_radiance(double height) const { return sun_illuminance(height) / kSunSolidAngle; }

    // The air along `distance` metres, which may be infinite, from any height: the integral, for single rays. At
    // distance 0 exactly {1, 0}; for a line that meets no ground {0, sky} in the end.
    AerialPerspective aerial(double height, const glm::dvec3& direction, double distance) const;

    // The same from the observer, for each sample: by a table, 50 ns, up to AerialTable::kHighest, above it the
    // integral.
    AerialPerspective aerial_from_observer(const glm::dvec3& direction, double distance) const;
    void aerial_from_observer(const DirectionBatch& directions, std::span<const float> distances,
                              const ColourBatch& transmittance, const ColourBatch& inscatter) const;

    // Light of the sky above the observer's horizon, and of the sphere below it, on a surface with a unit normal.
    glm::dvec3 sky_irradiance(const glm::dvec3& normal) const { return sky_irradiance_.at(normal); }
    glm::dvec3 ground_irradiance(const glm::dvec3& normal) const { return ground_irradiance_.at(normal); }

    // A direction into the sky; u0 and u1 in [0,1).
    SkySample sample_sky(double u0, double u1) const { return sampler_.sample(u0, u1); }
    double sky_pdf(const glm::dvec3& direction) const { return sampler_.pdf(direction); }

    const glm::dvec3& sun_direction() const { return frame_.sun; }
    double observer_height() const { return frame_.height; }

  private:
    SkyFrame frame_;
    AirLight light_;
    SkyTable sky_;
    AerialTable aerial_;
    SkyIrradiance sky_irradiance_, ground_irradiance_;
    SkySampler sampler_;
    std::vector<glm::vec3> sun_by_height_;
};

}  // namespace strata::shaders
