// draw_sky OUT.png VISIBILITY_M HEIGHT_M ELEVATION_DEG...
//
// A contact sheet to judge a Daylight by: a row for each elevation of the sun, each with an exposure of its own. Left
// the upper half of the sky as a fisheye, the sun's azimuth up; right half a turn of panorama about the sun, from 10
// degrees below to 40 above the horizon, with ridges of dark forest 2 to 120 km away, seen through the air.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

#include "shaders_cpu/daylight/daylight.h"
#include "src/image/write.h"

namespace {

using namespace strata;
using namespace strata::shaders;

constexpr double kPi = std::numbers::pi;
constexpr int kSide = 300;
constexpr int kPanorama = 900;

struct Ridge {
    double distance, height, phase;  // of its mean crest, from the observer's; metres
};
constexpr Ridge kRidges[] = {{2e3, -280, 0.3},  {5e3, -480, 1.7}, {12e3, -650, 3.9},
                             {28e3, -600, 0.9}, {60e3, 200, 5.1}, {120e3, 2200, 2.2}};

glm::dvec3 direction_of(double elevation, double azimuth) {
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
}

// The ridge's crest above the observer in metres: a few waves.
double crest(const Ridge& ridge, double azimuth) {
    double sum = 0.0;
    for (int k = 0; k < 7; ++k)
        sum += std::sin(azimuth * (5.0 + 1.2 * ridge.phase) * std::pow(1.83, k) + ridge.phase * (k + 1)) *
               std::pow(0.55, k);
    return ridge.height + 0.008 * ridge.distance * sum - ridge.distance * ridge.distance / (2.0 * kEarthRadius);
}

glm::dvec3 seen(const Daylight& daylight, double elevation, double azimuth) {
    const glm::dvec3 direction = direction_of(elevation, azimuth);
    for (const Ridge& ridge : kRidges) {
        if (std::tan(elevation) * ridge.distance > crest(ridge, azimuth)) continue;
        // Forest that faces the observer and a little up.
        const glm::dvec3 normal = glm::normalize(glm::dvec3(-direction.x, 0.5, -direction.z));
        const double facing = std::max(0.0, glm::dot(normal, daylight.sun_direction()));
        const glm::dvec3 light =
            daylight.sun_illuminance(daylight.observer_height()) * facing + daylight.sky_irradiance(normal);
        const AerialPerspective air = daylight.aerial_from_observer(direction, ridge.distance);
        return air.transmittance * glm::dvec3(0.03, 0.045, 0.02) * light / kPi + air.inscatter;
    }
    glm::dvec3 sky = daylight.sky_radiance(direction);
    if (glm::dot(direction, daylight.sun_direction()) > std::cos(kSunRadius))
        sky += daylight.sun_radiance(daylight.observer_height());
    return sky;
}

void draw_row(const Daylight& daylight, image::Picture& sheet, int top) {
    // Exposed for what the panorama shows above the horizon: its mean logarithm is a middle tone.
    double sum = 0.0;
    constexpr int kProbes = 30;
    for (int k = 0; k < kProbes * kProbes; ++k)
        sum += std::log(luminance(daylight.sky_radiance(direction_of(40.0 / 180.0 * kPi * (k / kProbes + 0.5) / kProbes,
                                                                     kPi * ((k % kProbes + 0.5) / kProbes - 0.5)))));
    const double exposure = 0.6 * std::exp(-sum / (kProbes * kProbes));
    const auto put = [&](int x, int y, const glm::dvec3& radiance) {
        const glm::dvec3 shown = 1.0 - glm::exp(-radiance * exposure);
        for (int c = 0; c < 3; ++c)
            sheet.rgb[3 * ((top + y) * sheet.frame_width + x) + c] = static_cast<float>(shown[c]);
    };
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double right = 2.0 * (x + 0.5) / kSide - 1.0;
            const double down = 2.0 * (y + 0.5) / kSide - 1.0;
            const double radius = std::hypot(right, down);
            if (radius < 1.0)
                put(x, y, daylight.sky_radiance(direction_of(kPi / 2 * (1.0 - radius), std::atan2(right, -down))));
        }
        for (int x = 0; x < kPanorama; ++x)
            put(kSide + x, y,
                seen(daylight, (40.0 - 50.0 * (y + 0.5) / kSide) / 180.0 * kPi, ((x + 0.5) / kPanorama - 0.5) * kPi));
    }
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 5) {
        std::fputs("usage: draw_sky OUT.png VISIBILITY_M HEIGHT_M ELEVATION_DEG...\n", stderr);
        return 2;
    }
    Atmosphere atmosphere;
    atmosphere.visibility = std::atof(argv[2]);
    const int rows = argc - 4;
    image::Picture sheet = image::make_picture(kSide + kPanorama, rows * kSide);
    for (int row = 0; row < rows; ++row) {
        const double elevation = std::atof(argv[4 + row]) / 180.0 * kPi;
        draw_row(Daylight(atmosphere, direction_of(elevation, 0.0), std::atof(argv[3])), sheet, row * kSide);
    }
    image::write_picture(argv[1], sheet);
} catch (const std::exception& error) {
    std::fprintf(stderr, "draw_sky: %s\n", error.what());
    return 1;
}
