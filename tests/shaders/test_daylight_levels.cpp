// Daylight against what has been measured and published.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "shaders_cpu/daylight/daylight.h"

using namespace strata::shaders;

namespace {

constexpr double kPi = std::numbers::pi;

Daylight day_at(double elevation_deg, double visibility = 60e3, double height = 0.0) {
    const double e = elevation_deg / 180.0 * kPi;
    Atmosphere atmosphere;
    atmosphere.visibility = visibility;
    return {atmosphere, {std::cos(e), std::sin(e), 0.0}, height};
}

double level_illuminance(const Daylight& day) {
    return luminance(day.sun_illuminance(0.0)) * std::max(0.0, day.sun_direction().y) +
           luminance(day.sky_irradiance({0, 1, 0}));
}

// Of level ground under a clear sky, lux: Janiczek and DeYoung, "Computer programs for sun and moon illuminance", U.S.
// Naval Observatory Circular 171 (1987): cubics in the elevation over 90 degrees for the logarithm.
double published_illuminance(double elevation_deg) {
    const double x = elevation_deg / 90.0;
    const auto cubic = [x](double a, double b, double c, double d) {
        return std::pow(10.0, a + x * (b + x * (c + x * d)));
    };
    if (elevation_deg >= 20.0) return cubic(3.74, 3.97, -4.07, 1.47);
    if (elevation_deg >= 5.0) return cubic(3.05, 13.28, -45.98, 64.33);
    if (elevation_deg >= -0.8) return cubic(2.88, 22.26, -207.64, 1034.30);
    if (elevation_deg >= -5.0) return cubic(2.88, 21.81, -258.11, -858.36);
    return cubic(2.70, 12.17, -431.69, -1899.83);
}

}  // namespace

TEST_CASE("the sun outside the atmosphere is the published 133.1 klx") {
    // Darula, Kittler and Gueymard, Solar Energy 79 (2005).
    CHECK(luminance(to_rgb(Bands(1.0))) == doctest::Approx(133.1e3).epsilon(0.01));
    CHECK(kSunSolidAngle == doctest::Approx(2.0 * kPi * (1.0 - std::cos(kSunRadius))).epsilon(1e-3));
}

TEST_CASE("a high sun gives 100 klx, open shade 5 to 20 klx, and shadows lie 2.5 to 4 stops below") {
    for (const double elevation : {40.0, 60.0, 90.0})
        for (const double visibility : {40e3, 60e3, 120e3}) {
            const Daylight day = day_at(elevation, visibility);
            const double sun = luminance(day.sun_illuminance(0.0));
            const double shade = luminance(day.sky_irradiance({0, 1, 0}));
            CAPTURE(elevation);
            CHECK(sun > 85e3);
            CHECK(sun < 120e3);
            CHECK(shade > 5e3);
            CHECK(shade < 20e3);
            const double stops = std::log2((sun * day.sun_direction().y + shade) / shade);
            CHECK(stops > 2.0);
            CHECK(stops < 4.0);
            const glm::dvec3 blue = day.sky_irradiance({0, 1, 0});
            CHECK(blue.b > 1.4 * blue.r);
        }
}

TEST_CASE("level ground has the published illuminance from noon to twilight") {
    for (const double elevation : {90.0, 60.0, 30.0, 20.0, 10.0, 5.0, 0.0, -2.0, -4.0, -6.0}) {
        const double here = level_illuminance(day_at(elevation));
        const double published = published_illuminance(elevation);
        MESSAGE("sun at ", elevation, ": ", here, " lux, published ", published, ", ratio ", here / published);
        CHECK(here / published > 1.0 / 1.5);
        CHECK(here / published < 1.5);
    }
}

TEST_CASE("blue hour: a few lux of blue at -6 degrees") {
    const Daylight day = day_at(-6.0);
    const glm::dvec3 light = day.sky_irradiance({0, 1, 0});
    CHECK(luminance(light) > 1.5);
    CHECK(luminance(light) < 6.0);
    CHECK(light.b > 1.8 * light.r);
    const glm::dvec3 zenith = day.sky_radiance({0, 1, 0});
    CHECK(zenith.b > 3.0 * zenith.r);
    CHECK(zenith.g > zenith.r);
}

TEST_CASE("without ozone twilight's zenith is not blue") {
    Atmosphere atmosphere;
    const glm::dvec3 sun(std::cos(-4.0 / 180.0 * kPi), std::sin(-4.0 / 180.0 * kPi), 0.0);
    const glm::dvec3 with = Daylight(atmosphere, sun, 0.0).sky_radiance({0, 1, 0});
    atmosphere.ozone_dobson = 0.0;
    const glm::dvec3 without = Daylight(atmosphere, sun, 0.0).sky_radiance({0, 1, 0});
    CHECK(with.b / with.r > 1.5);
    CHECK(without.b / without.r < 0.6 * with.b / with.r);
}

TEST_CASE("by day the horizon is brighter than the zenith, which is blue and of 1 to 5 kcd/m^2") {
    for (const double elevation : {15.0, 30.0, 45.0}) {
        const Daylight day = day_at(elevation);
        const glm::dvec3 zenith = day.sky_radiance({0, 1, 0});
        CHECK(zenith.b > 1.8 * zenith.r);
        CHECK(luminance(zenith) > (elevation > 20.0 ? 1e3 : 700.0));
        CHECK(luminance(zenith) < 5e3);
        for (const double azimuth : {0.5, 1.5, 3.1}) {
            const glm::dvec3 horizon = day.sky_radiance({std::cos(azimuth), 0.0, std::sin(azimuth)});
            CHECK(luminance(horizon) > 2.0 * luminance(zenith));
            CHECK(horizon.b / horizon.r < 0.6 * zenith.b / zenith.r);  // and whiter
        }
    }
}

TEST_CASE("a low sun reddens, its horizon warms, and the Earth's shadow rises opposite") {
    const glm::dvec3 low = day_at(2.0).sun_illuminance(0.0);
    CHECK(low.r > 2.0 * low.g);
    CHECK(low.g > 5.0 * low.b);
    const glm::dvec3 glow = day_at(0.0).sky_radiance({std::cos(0.01), std::sin(0.01), 0.0});
    CHECK(glow.r > glow.g);
    CHECK(glow.g > glow.b);
    const Daylight dusk = day_at(-2.0);
    const auto opposite = [&](double elevation_deg) {
        const double e = elevation_deg / 180.0 * kPi;
        return dusk.sky_radiance({-std::cos(e), std::sin(e), 0.0});
    };
    const glm::dvec3 shadow = opposite(0.7);
    const glm::dvec3 belt = opposite(6.0);
    CHECK(luminance(shadow) < luminance(belt));
    CHECK(shadow.b / shadow.r > belt.b / belt.r);  // blue below, pink above
}

TEST_CASE("from higher up the sky is darker and the sun whiter") {
    const Daylight sea = day_at(30.0);
    const Daylight peak = day_at(30.0, 60e3, 4000.0);
    const Daylight space = day_at(30.0, 60e3, 100e3);
    CHECK(luminance(peak.sky_radiance({0, 1, 0})) < 0.7 * luminance(sea.sky_radiance({0, 1, 0})));
    CHECK(luminance(space.sky_radiance({0, 1, 0})) < 1e-3 * luminance(sea.sky_radiance({0, 1, 0})));
    CHECK(luminance(sea.sun_illuminance(4000.0)) > 1.1 * luminance(sea.sun_illuminance(0.0)));
    CHECK(luminance(sea.sun_illuminance(100e3)) == doctest::Approx(132.5e3).epsilon(1e-3));
}

TEST_CASE("air's optical depth is the published one") {
    // Bodhaine et al. 1999, for 1013.25 hPa and 360 ppm CO2: 0.0972 at 550 nm, 0.3614 at 400 nm to 1 %, as sigma P A /
    // m g.
    Atmosphere atmosphere;
    atmosphere.visibility = 1e9;
    const AirModel medium(atmosphere);
    const double column = columns_to_top(medium, 0.0, 1.0).air;
    const double molecules = medium.full().air[0] / rayleigh_cross_section(kBand_nm[0]);
    CHECK(molecules * column * rayleigh_cross_section(550.0) == doctest::Approx(0.0972).epsilon(0.01));
    CHECK(molecules * column * rayleigh_cross_section(400.0) == doctest::Approx(0.3614).epsilon(0.01));
    CHECK(medium.full().haze == Bands(0.0));
}

TEST_CASE("level air transmits as its Rayleigh coefficient says") {
    Atmosphere atmosphere;
    atmosphere.visibility = 1e9;
    atmosphere.ozone_dobson = 0.0;
    // The coefficients in common use, 5.802, 13.558 and 33.1e-6 /m for 680, 550 and 440 nm, are 18 % above those of air
    // at sea level: they come from a refractivity of 3e-4 and no more digits. `air` brings them back.
    atmosphere.air = 1.18;
    const AirModel medium(atmosphere);
    const double molecules = medium.full().air[0] / rayleigh_cross_section(kBand_nm[0]);
    const double wavelengths[3] = {680.0, 550.0, 440.0};
    const double at_10_km[3] = {0.94, 0.87, 0.72};
    const double at_50_km[3] = {0.75, 0.51, 0.19};
    for (int c = 0; c < 3; ++c) {
        const double coefficient = molecules * rayleigh_cross_section(wavelengths[c]);
        CHECK(std::fabs(std::exp(-10e3 * coefficient) - at_10_km[c]) < 0.01);
        CHECK(std::fabs(std::exp(-50e3 * coefficient) - at_50_km[c]) < 0.01);
    }
    // And the path itself, at the channels' wavelengths: level at sea level it rises 8 m in 10 km.
    const AerialPerspective air = Daylight(atmosphere, {0, 1, 0}, 0.0).aerial(0.0, {1, 0, 0}, 10e3);
    for (int c = 0; c < 3; ++c) {
        CHECK(air.transmittance[c] ==
              doctest::Approx(std::exp(-10e3 * molecules * rayleigh_cross_section(kChannel_nm[c]))).epsilon(1e-3));
        CHECK(std::fabs(air.transmittance[c] - at_10_km[c]) < 0.02);
    }
}

TEST_CASE("visibility is the distance at which a black thing's contrast is two hundredths") {
    for (const double visibility : {10e3, 50e3, 150e3}) {
        const Daylight day = day_at(50.0, visibility);
        const AerialPerspective air = day.aerial(0.0, {1, 0, 0}, visibility);
        // Level light rises with the Earth's curvature, into thinner haze.
        CHECK(air.transmittance.g > 0.018);
        CHECK(air.transmittance.g < 0.06);
    }
}
