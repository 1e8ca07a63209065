// What cases of light share: directions, what is no light, and small pictures that are compared.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "src/integrate/image_function.h"
#include "src/scene/scene.h"
#include "tools/stability/case.h"

namespace strata::tools::stability {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kRadian = std::numbers::pi / 180.0;

inline double unit(Random& random) { return std::uniform_real_distribution<double>()(random); }

glm::dvec3 towards(double elevation, double azimuth);

// Half of the directions within a ten-thousandth of the horizon, where rays through the air are longest.
glm::dvec3 any_direction(Random& random);

// How far a colour is from being light: 0 where it is finite and not negative.
double ill(const glm::dvec3& colour);

using ChangeScene = std::function<void(scene::Scene&)>;

// A built-in scene at 24 x 16 pixels.
struct SmallPicture {
    std::vector<glm::vec3> pixels;
    integrate::Counters counters;
};
SmallPicture small_picture(const char* name, const ChangeScene& change);

// Pixels that differ between two settings which mean the same.
double differing(const char* name, const ChangeScene& one, const ChangeScene& other);

}  // namespace strata::tools::stability
