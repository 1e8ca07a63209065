// All orders of scattering, with haze's true lobe, against light paths followed at random; and the second order in more
// directions than the fast test has time for.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shaders_cpu/daylight/air_light.h"
#include "shaders_cpu/daylight/sky_frame.h"
#include "tests/shaders/daylight_oracle.h"

using namespace strata::shaders;

namespace {

constexpr double kPi = std::numbers::pi;

struct Sky {
    AirLight light;
    SkyFrame frame;
    daylight_oracle::Oracle oracle;
    int band;

    Sky(const Atmosphere& a, int orders, ScatteredLight::Rest rest, int band_, double elevation_deg, double height)
        : light(a, orders, rest),
          frame({std::cos(elevation_deg / 180.0 * kPi), std::sin(elevation_deg / 180.0 * kPi), 0.0}, height),
          oracle(daylight_oracle::make_air(kBand_nm[band_], a.visibility, a.haze_forward, a.haze_albedo,
                                           a.haze_exponent, kOzoneCrossSection[band_], a.ground_albedo),
                 frame.sun),
          band(band_) {}

    double model(const glm::dvec3& d) const {
        const double cosine = glm::dot(d, frame.sun);
        return light.total(light.of_sky(frame.height, d.y, frame.sun.y, cosine), cosine)[band];
    }
    glm::dvec3 eye() const { return {0.0, daylight_oracle::kEarth + frame.height, 0.0}; }
};

glm::dvec3 random_direction(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit;
    const double up = std::pow(unit(random), 2.0);
    const double azimuth = 2.0 * kPi * unit(random);
    const double level = std::sqrt(1.0 - up * up);
    return {level * std::cos(azimuth), up, level * std::sin(azimuth)};
}

}  // namespace

TEST_CASE("light scattered once or twice is brute force's in 1000 directions") {
    Atmosphere atmosphere;
    atmosphere.visibility = 50e3;
    atmosphere.haze_forward = 0.0;
    std::mt19937_64 random(2);
    for (const double elevation : {70.0, 30.0, 10.0, 2.0, -2.0}) {
        const int band = static_cast<int>(std::fabs(elevation)) / 10 % 4;
        const Sky sky(atmosphere, 1, ScatteredLight::Rest::kNone, band, elevation, 1000.0);
        double squares = 0.0, worst = 0.0;
        constexpr int kDirections = 200;
        for (int i = 0; i < kDirections; ++i) {
            const glm::dvec3 d = random_direction(random);
            const double error =
                sky.model(d) / (sky.oracle.single(sky.eye(), d, 0.05) + sky.oracle.second(sky.eye(), d)) - 1.0;
            squares += error * error / kDirections;
            worst = std::max(worst, std::fabs(error));
        }
        MESSAGE("sun at ", elevation, ": rms ", std::sqrt(squares), ", worst ", worst);
        CHECK(std::sqrt(squares) < (elevation > 0.0 ? 0.02 : 0.05));
        CHECK(worst < (elevation > 0.0 ? 0.05 : 0.15));
    }
}

TEST_CASE("all orders together are those of light paths") {
    std::mt19937_64 random(4);
    for (const double visibility : {200e3, 60e3}) {
        Atmosphere atmosphere;
        atmosphere.visibility = visibility;
        for (const double elevation : {70.0, 30.0, 10.0, 3.0, 0.0})
            for (const int band : {0, 3}) {
                const Sky sky(atmosphere, AirLight::kOrders, ScatteredLight::Rest::kSeries, band, elevation, 500.0);
                double mean = 0.0, squares = 0.0, noise = 0.0, worst = 0.0;
                constexpr int kDirections = 40;
                for (int i = 0; i < kDirections; ++i) {
                    const glm::dvec3 d = random_direction(random);
                    const auto truth = sky.oracle.paths(sky.eye(), d, 20000, random);
                    const double error = sky.model(d) / truth.mean - 1.0;
                    mean += error / kDirections;
                    squares += error * error / kDirections;
                    noise += truth.error / truth.mean / kDirections;
                    worst = std::max(worst, std::fabs(error));
                }
                MESSAGE("visibility ", visibility / 1e3, " km, sun at ", elevation, ", ", kBand_nm[band], " nm: mean ",
                        mean, ", rms ", std::sqrt(squares), ", worst ", worst, "; noise ", noise);
                const bool clear = visibility > 100e3;
                CHECK(std::fabs(mean) < (clear ? 0.03 : 0.1));
                CHECK(std::sqrt(squares) < (clear ? 0.06 : 0.2));
            }
    }
}
