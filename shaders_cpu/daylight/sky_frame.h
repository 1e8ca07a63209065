// Directions as the tables have them: the sky is symmetric about the sun's azimuth.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace strata::shaders {

struct SkyDirection {
    double up;       // cosine to the vertical
    double azimuth;  // cosine of the azimuth from the sun's
    double cosine;   // to the sun
};

// The light that one observer sees.
struct SkyFrame {
    glm::dvec3 sun;                       // unit, y up
    double height;                        // metres
    double level_x = 1.0, level_z = 0.0;  // of the sun's azimuth; any for a sun overhead

    SkyFrame(const glm::dvec3& sun_direction, double observer_height) : sun(sun_direction), height(observer_height) {
        const double level = std::hypot(sun.x, sun.z);
        if (level > 0.0) {
            level_x = sun.x / level;
            level_z = sun.z / level;
        }
    }

    SkyDirection locate(double x, double y, double z) const {
        const double level = std::sqrt(x * x + z * z);
        const double azimuth = level > 0.0 ? (x * level_x + z * level_z) / level : 0.0;
        return {y, azimuth, x * sun.x + y * sun.y + z * sun.z};
    }

    double cosine_of(double up, double azimuth) const {
        const double level = std::sqrt(std::max(0.0, (1.0 - up * up) * (1.0 - sun.y * sun.y)));
        return up * sun.y + level * azimuth;
    }
};

}  // namespace strata::shaders
