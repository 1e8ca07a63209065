// Rays that are hard on a tracer, made for a scene.
#pragma once

#include <vector>

#include "src/trace/field.h"
#include "tools/stability/ray_jury.h"

namespace strata::tools::stability {

double uniform(Random& random, double a, double b);
double log_uniform(Random& random, double a, double b);

glm::dvec3 unit_vector(Random& random);

// The last double outside of a segment's crossing of the surface, in surface coordinates.
glm::dvec3 surface_point(const trace::Field& field, glm::dvec3 outside, glm::dvec3 inside);

// About `count` rays of a kind. All but pixel_rays take the surface's coordinates for the world's.
using MakeRays = std::vector<WorldRay> (*)(const RayJury&, Random&, int count);

std::vector<WorldRay> grazing_rays(const RayJury& jury, Random& random, int count);
std::vector<WorldRay> ridge_rays(const RayJury& jury, Random& random, int count);
std::vector<WorldRay> starting_rays(const RayJury& jury, Random& random, int count);
std::vector<WorldRay> pixel_rays(const RayJury& jury, Random& random, int count);

}  // namespace strata::tools::stability
