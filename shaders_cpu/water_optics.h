// What a level face between air and water does with light, by the laws of Fresnel and Snell.
#pragma once

#include <glm/glm.hpp>

namespace strata::shaders {

// Of fresh water at 20 degrees for yellow light, against air (CRC Handbook of Chemistry and Physics).
inline constexpr double kWaterIndex = 1.333;

// Share of unpolarised light that comes from the air at an angle of the given cosine, in [0,1], and is reflected; the
// rest goes in. 1 for cosine 0, ((n - 1) / (n + 1))^2 for 1. The same for light that comes from below along the
// refracted ray.
double fresnel(double cosine);

// Where light of a unit direction goes that meets a face with the unit normal `normal`, dot(direction, normal) <= 0:
// in, of unit length.
glm::dvec3 refracted(const glm::dvec3& direction, const glm::dvec3& normal);

// Where the air lies for one who looks up from under level water, along a unit direction with y > 0; what is reflected
// totally, along the face. The inverse of refracted(-x, up), turned about.
glm::dvec3 out_of_water(const glm::dvec3& direction);

// Of even light from all over the water, the share that is reflected; and of even light from below, the share that
// stays below: as much leaves as comes in where radiance below is n^2 times that above, so that
// 1 - below = (1 - above) / n^2.
double even_light_reflected();
double even_light_kept();

// Mean of 1 / cosine under water over even light from above, weighted by what crosses the level: the length of its ways
// down over the depth. The integral of du / sqrt(1 - u / n^2) over [0,1], u the squared sine in the air:
// 2 n^2 (1 - sqrt(1 - 1 / n^2)) = 1.2039.
inline constexpr double kEvenLightPath = 1.2039;

}  // namespace strata::shaders
