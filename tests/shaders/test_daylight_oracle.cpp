// Sky radiance against brute force. test_daylight_paths_slow.cpp has the orders beyond the second.
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

// Haze that scatters evenly, for which the split of its lobe is exact.
Atmosphere even_haze() {
    Atmosphere atmosphere;
    atmosphere.visibility = 50e3;
    atmosphere.haze_forward = 0.0;
    return atmosphere;
}

struct Errors {
    double root_mean_square = 0.0, worst = 0.0, mean = 0.0;
};

// Relative errors of `directions` random ones, crowded at the horizon, one band. Where there is next to no light, as in
// the Earth's shadow, they are relative to a twentieth of the mean.
Errors compare(const AirLight& light, int band, double elevation_deg, double height, int directions, bool second) {
    const double e = elevation_deg / 180.0 * kPi;
    const SkyFrame frame({std::cos(e), std::sin(e), 0.0}, height);
    const Atmosphere a = even_haze();
    const daylight_oracle::Oracle oracle(
        daylight_oracle::make_air(kBand_nm[band], a.visibility, 0.0, a.haze_albedo, a.haze_exponent,
                                  kOzoneCrossSection[band], a.ground_albedo),
        frame.sun);
    std::mt19937_64 random(1000 * band + 7);
    std::uniform_real_distribution<double> unit;
    std::vector<double> model, truth;
    double mean = 0.0;
    for (int i = 0; i < directions; ++i) {
        const double x = unit(random);
        const double up = i % 4 < 3 ? x * x : -0.01 - 0.98 * x * x;
        const double azimuth = 2.0 * kPi * unit(random);
        const double level = std::sqrt(1.0 - up * up);
        const glm::dvec3 d(level * std::cos(azimuth), up, level * std::sin(azimuth));
        const double cosine = glm::dot(d, frame.sun);
        model.push_back(light.total(light.of_sky(height, up, frame.sun.y, cosine), cosine)[band]);
        const glm::dvec3 eye(0.0, daylight_oracle::kEarth + height, 0.0);
        truth.push_back(oracle.single(eye, d, 0.05) + (second ? oracle.second(eye, d) : 0.0));
        mean += truth.back() / directions;
    }
    Errors errors;
    for (int i = 0; i < directions; ++i) {
        const double error = (model[i] - truth[i]) / (truth[i] + 0.05 * mean);
        errors.worst = std::max(errors.worst, std::fabs(error));
        errors.mean += error / directions;
        errors.root_mean_square += error * error / directions;
    }
    errors.root_mean_square = std::sqrt(errors.root_mean_square);
    MESSAGE("sun at ", elevation_deg, ", ", kBand_nm[band], " nm: rms ", errors.root_mean_square, ", mean ",
            errors.mean, ", worst ", errors.worst);
    return errors;
}

}  // namespace

TEST_CASE("light scattered once is brute force's in 1200 directions") {
    const AirLight light(even_haze(), 0, ScatteredLight::Rest::kNone);
    int band = 0;
    for (const double elevation : {90.0, 50.0, 20.0, 5.0, 0.0, -4.0}) {
        const Errors errors = compare(light, band++ % 4, elevation, 1000.0, 200, false);
        CHECK(errors.root_mean_square < 0.004);
        CHECK(errors.worst < 0.012);
    }
}

TEST_CASE("light scattered once or twice is brute force's in 120 directions") {
    const AirLight light(even_haze(), 1, ScatteredLight::Rest::kNone);
    for (const double elevation : {50.0, 5.0}) {
        const Errors errors = compare(light, elevation > 20.0 ? 3 : 0, elevation, 1000.0, 40, true);
        CHECK(errors.root_mean_square < 0.015);
        CHECK(errors.worst < 0.04);
    }
    const Errors errors = compare(light, 2, -4.0, 1000.0, 40, true);
    CHECK(errors.root_mean_square < 0.05);
    CHECK(errors.worst < 0.1);
}
