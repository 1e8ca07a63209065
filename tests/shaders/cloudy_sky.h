// A sky with a layer of clouds, for tests.
#pragma once

#include <cmath>
#include <limits>

#include "shaders_cpu/cloud_scene.h"

namespace strata::cloudy_sky {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline scene::Scene cloudy() {
    scene::Scene scene;
    scene.sky.model = scene::SkyModel::daylight;
    scene.scale.metres = 100.0;
    scene.sun.direction = {0.6, 0.5, -0.3};
    scene.clouds = {{.name = "layer", .altitude_m = 2600.0, .size_m = 3000.0, .warp_m = 300.0}};
    return scene;
}

struct Sky {
    scene::Scene scene;
    shaders::DaylightScene daylight;
    shaders::CloudScene clouds;

    explicit Sky(const scene::Scene& from, const glm::dvec3& eye = glm::dvec3(0.0))
        : scene(from),
          daylight(scene, glm::normalize(scene.sun.direction), eye),
          clouds(scene, daylight, glm::normalize(scene.sun.direction)) {}
};

inline glm::dvec3 at_elevation(double degrees, double azimuth) {
    const double e = glm::radians(degrees);
    return {std::cos(e) * std::cos(azimuth), std::sin(e), std::cos(e) * std::sin(azimuth)};
}

}  // namespace strata::cloudy_sky
