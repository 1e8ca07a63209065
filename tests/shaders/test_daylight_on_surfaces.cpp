// What a Daylight gives a surface: sunlight, the sky's irradiance and directions to sample it; and what it refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "shaders_cpu/daylight/daylight.h"

using namespace strata::shaders;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 direction_of(double elevation_deg, double azimuth) {
    const double e = elevation_deg / 180.0 * kPi;
    return {std::cos(e) * std::cos(azimuth), std::sin(e), std::cos(e) * std::sin(azimuth)};
}

glm::dvec3 direction_at(double y, double azimuth) {
    const double level = std::sqrt(std::max(0.0, 1.0 - y * y));
    return {level * std::cos(azimuth), y, level * std::sin(azimuth)};
}

}  // namespace

TEST_CASE("irradiance is the sky's cosine-weighted sum") {
    for (const double elevation : {70.0, 15.0, -3.0}) {
        const Daylight day(Atmosphere{}, direction_of(elevation, 0.0), 1000.0);
        double worst = 0.0, brightest = 0.0;
        for (const double up : {1.0, 0.7, 0.2, 0.0, -0.5})
            for (const double around : {0.0, 1.5, 3.1}) {
                const glm::dvec3 n = direction_at(up, around);
                double sum = 0.0;
                constexpr int kRows = 300, kColumns = 200;
                for (int i = 0; i < kRows; ++i)
                    for (int j = 0; j < kColumns; ++j) {
                        const double x = (i + 0.5) / kRows;
                        const glm::dvec3 d = direction_at(x * x, 2.0 * kPi * (j + 0.5) / kColumns);
                        sum += luminance(day.sky_radiance(d)) * std::max(0.0, glm::dot(d, n)) * 2.0 * x / kRows * 2.0 *
                               kPi / kColumns;
                    }
                worst = std::max(worst, std::fabs(sum - luminance(day.sky_irradiance(n))));
                brightest = std::max(brightest, sum);
            }
        worst /= brightest;
        MESSAGE("sun at ", elevation, ": within ", worst, " of the brightest side");
        CHECK(worst < 0.12);  // a narrow light's: nine coefficients cannot follow a cosine that ends at 0
    }
}

TEST_CASE("the density of sampled directions integrates to one and is the one they have") {
    for (const double elevation : {50.0, 1.0, -6.0}) {
        const Daylight day(Atmosphere{}, direction_of(elevation, 0.4), 0.0);
        constexpr int kRows = 320, kColumns = 640;  // whole multiples of its cells
        double integral = 0.0, light = 0.0;
        for (int i = 0; i < kRows; ++i)
            for (int j = 0; j < kColumns; ++j) {
                const glm::dvec3 d = direction_at((i + 0.5) / kRows, 2.0 * kPi * (j + 0.5) / kColumns);
                integral += day.sky_pdf(d) * 2.0 * kPi / (kRows * kColumns);
                light += luminance(day.sky_radiance(d)) * d.y * 2.0 * kPi / (kRows * kColumns);
            }
        CHECK(integral == doctest::Approx(1.0).epsilon(1e-9));
        CHECK(day.sky_pdf({0, -1, 0}) == 0.0);
        // Level ground's light by samples: right, and of little noise, which a wrong density would spoil.
        constexpr int kSide = 64;
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < kSide; ++i)
            for (int j = 0; j < kSide; ++j) {
                const SkySample sample = day.sample_sky((i + 0.5) / kSide, (j + 0.5) / kSide);
                CHECK(sample.pdf == doctest::Approx(day.sky_pdf(sample.direction)));
                CHECK(glm::length(sample.direction) == doctest::Approx(1.0));
                const double value = luminance(day.sky_radiance(sample.direction)) * sample.direction.y / sample.pdf;
                sum += value;
                squares += value * value;
            }
        const double mean = sum / (kSide * kSide);
        const double spread = std::sqrt(squares / (kSide * kSide) / (mean * mean) - 1.0);
        CHECK(mean == doctest::Approx(light).epsilon(0.01));
        MESSAGE("sun at ", elevation, ": a sample's standard deviation is ", spread, " of the mean");
        CHECK(spread < 0.5);
    }
}

TEST_CASE("as many directions are sampled anywhere as the density says, within its cells too") {
    const Daylight day(Atmosphere{}, direction_of(20.0, 0.4), 0.0);
    constexpr int kRows = 16, kColumns = 192;  // a third of a cell's width and two cells high
    constexpr int kSide = 1000;
    std::vector<double> found(kRows * kColumns);
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const glm::dvec3 d = day.sample_sky((i + 0.5) / kSide, (j + 0.5) / kSide).direction;
            const double turns = std::atan2(d.z, d.x) / (2.0 * kPi);
            const int row = std::min(static_cast<int>(d.y * kRows), kRows - 1);
            const int column = std::min(static_cast<int>((turns < 0.0 ? turns + 1.0 : turns) * kColumns), kColumns - 1);
            found[row * kColumns + column] += 1.0 / (kSide * kSide);
        }
    double worst = 0.0;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            double expected_share = 0.0;
            for (const double y : {row + 0.25, row + 0.75})
                expected_share += 0.5 * day.sky_pdf(direction_at(y / kRows, 2.0 * kPi * (column + 0.5) / kColumns)) *
                                  2.0 * kPi / (kRows * kColumns);
            // The lattice leaves dim bins to a few dozen samples.
            const double scale = expected_share + 0.5 / (kRows * kColumns);
            worst = std::max(worst, std::fabs(found[row * kColumns + column] - expected_share) / scale);
        }
    MESSAGE("share of samples within ", worst, " of the density's");
    CHECK(worst < 0.25);
}

TEST_CASE("sunlight fades while the disc sets, and sets later higher up") {
    const AirModel medium{Atmosphere{}};
    double before = kInfinity;
    for (double elevation = 1.0; elevation > -0.4; elevation -= 0.02) {
        const double light = sunlight(medium, 0.0, std::sin(elevation / 180.0 * kPi)).full[0];
        CHECK(light <= before);
        if (elevation < -0.267) CHECK(light == 0.0);
        if (elevation > -0.25) CHECK(light > 0.0);
        before = light;
    }
    const Daylight dusk(Atmosphere{}, direction_of(-1.0, 0.0), 0.0);
    CHECK(luminance(dusk.sun_illuminance(490.0)) < 0.1);     // its horizon is 0.7 degrees down
    const glm::dvec3 summit = dusk.sun_illuminance(3000.0);  // 1.76 degrees
    CHECK(luminance(summit) > 100.0);
    CHECK(summit.r > 3.0 * summit.g);  // alpenglow
    CHECK(dusk.sun_radiance(3000.0).r == doctest::Approx(summit.r / 6.80e-5));
}

TEST_CASE("without air the setting sun gives as much light as its disc shows") {
    Atmosphere vacuum;
    vacuum.visibility = 1e9;
    vacuum.air = vacuum.ozone_dobson = 0.0;
    vacuum.haze_albedo = 0.0;
    const AirModel medium(vacuum);
    for (const double above : {-2.0, -1.0, -0.7, 0.0, 0.5, 0.99, 1.0, 3.0}) {  // radii of the disc
        // Share of a unit disc beyond a chord, by a sum over strips.
        double share = 0.0;
        constexpr int kStrips = 20000;
        for (int k = 0; k < kStrips; ++k) {
            const double y = 2.0 * (k + 0.5) / kStrips - 1.0;
            if (y > -above) share += std::sqrt(1.0 - y * y) * 4.0 / (kPi * kStrips);
        }
        CHECK(sunlight(medium, 0.0, std::sin(above * kSunRadius)).full[0] == doctest::Approx(share).epsilon(2e-3));
    }
}

TEST_CASE("what cannot be is refused by name") {
    const auto refused = [](auto change) {
        Atmosphere atmosphere;
        change(atmosphere);
        CHECK_THROWS_AS(validate(atmosphere), std::invalid_argument);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {-1.0, nan, kInfinity}) {
        refused([&](Atmosphere& a) { a.visibility = bad; });
        refused([&](Atmosphere& a) { a.haze_height = bad; });
        refused([&](Atmosphere& a) { a.haze_forward = bad; });
        refused([&](Atmosphere& a) { a.haze_albedo = bad; });
        refused([&](Atmosphere& a) { a.ozone_dobson = bad; });
        refused([&](Atmosphere& a) { a.air = bad; });
        refused([&](Atmosphere& a) { a.ground_albedo = bad; });
    }
    refused([&](Atmosphere& a) { a.haze_exponent = nan; });
    CHECK_NOTHROW(validate(Atmosphere{}));
    CHECK_THROWS_WITH_AS(Daylight(Atmosphere{}, {0, 2, 0}, 0.0), "daylight: sun_direction has length 2; allowed: 1",
                         std::invalid_argument);
    CHECK_THROWS_AS(Daylight(Atmosphere{}, {0, nan, 0}, 0.0), std::invalid_argument);
    for (const double height : {-1001.0, 100001.0, nan})
        CHECK_THROWS_AS(Daylight(Atmosphere{}, {0, 1, 0}, height), std::invalid_argument);
}
