// Four bands against the whole spectrum.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "shaders_cpu/daylight/air_light.h"
#include "tests/shaders/daylight_oracle.h"

using namespace strata::shaders;

namespace {

constexpr int kSamples = 35;  // 380 to 720 nm

double wavelength(int i) { return 380.0 + 10.0 * i; }

// The CIE 1931 observer.
constexpr double kObserver[kSamples][3] = {
    {.0014, .0000, .0065},  {.0042, .0001, .0201},  {.0143, .0004, .0679},  {.0435, .0012, .2074},
    {.1344, .0040, .6456},  {.2839, .0116, 1.3856}, {.3483, .0230, 1.7471}, {.3362, .0380, 1.7721},
    {.2908, .0600, 1.6692}, {.1954, .0910, 1.2876}, {.0956, .1390, .8130},  {.0320, .2080, .4652},
    {.0049, .3230, .2720},  {.0093, .5030, .1582},  {.0633, .7100, .0782},  {.1655, .8620, .0422},
    {.2904, .9540, .0203},  {.4334, .9950, .0087},  {.5945, .9950, .0039},  {.7621, .9520, .0021},
    {.9163, .8700, .0017},  {1.0263, .7570, .0011}, {1.0622, .6310, .0008}, {1.0026, .5030, .0003},
    {.8544, .3810, .0002},  {.6424, .2650, .0000},  {.4479, .1750, .0000},  {.2835, .1070, .0000},
    {.1649, .0610, .0000},  {.0874, .0320, .0000},  {.0468, .0170, .0000},  {.0227, .0082, .0000},
    {.0114, .0041, .0000},  {.0058, .0021, .0000},  {.0029, .0010, .0000}};

// The sun outside the atmosphere, W/m^2/nm (ASTM G173).
constexpr double kSun[kSamples] = {1.01249, 1.14716, 1.72765, 1.73054, 1.6887, 1.61253, 1.91198, 2.03474, 2.02042,
                                   2.02212, 1.93377, 1.95809, 1.91686, 1.8298, 1.8685,  1.8931,  1.85149, 1.8504,
                                   1.8341,  1.8345,  1.8147,  1.78158, 1.7533, 1.6965,  1.68194, 1.64654, 1.6048,
                                   1.52143, 1.55622, 1.5113,  1.474,   1.4482, 1.41018, 1.36775, 1.34188};

// Ozone, 1e-27 m^2 (Serdyuchenko and Gorshelev 2014, means over 10 nm).
constexpr double kOzone[kSamples] = {.2818, .6636, 1.527, 2.763, 5.52,  8.451, 15.82, 23.16, 36.69, 49.24, 77.52, 90.16,
                                     148.0, 160.2, 213.9, 275.5, 309.1, 350.0, 426.6, 467.2, 439.8, 470.1, 501.9, 430.5,
                                     374.0, 321.5, 266.2, 223.8, 185.2, 147.3, 120.9, 94.23, 74.55, 65.66, 51.05};

struct Colour {
    double luminance, u, v;
};

Colour colour_of(const glm::dvec3& xyz) {
    const double sum = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    return {xyz.y, 4.0 * xyz.x / sum, 9.0 * xyz.y / sum};
}

Colour colour_of_rgb(const glm::dvec3& c) {
    return colour_of({0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b,
                      0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b,
                      0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b});
}

template <class Spectrum>
Colour colour_of_spectrum(const Spectrum& relative_to_sun) {
    glm::dvec3 xyz(0.0);
    for (int i = 0; i < kSamples; ++i)
        xyz += glm::dvec3(kObserver[i][0], kObserver[i][1], kObserver[i][2]) *
               (683.0 * 10.0 * kSun[i] * relative_to_sun(i));
    return colour_of(xyz);
}

void check_close(const Colour& bands, const Colour& spectrum, double colour, double light) {
    const double apart = std::hypot(bands.u - spectrum.u, bands.v - spectrum.v);
    MESSAGE("(u',v') apart by ", apart, ", luminance by ", bands.luminance / spectrum.luminance - 1.0);
    CHECK(apart < colour);
    CHECK(bands.luminance == doctest::Approx(spectrum.luminance).epsilon(light));
}

}  // namespace

TEST_CASE("the sun has its spectrum's colour from the zenith to the horizon") {
    const Atmosphere atmosphere;
    const AirModel medium(atmosphere);
    for (const double elevation : {90.0, 30.0, 10.0, 5.0, 2.0, 0.5}) {
        CAPTURE(elevation);
        const Densities columns = columns_to_top(medium, 0.0, std::sin(elevation / 180.0 * std::numbers::pi));
        const auto spectrum = [&](int i) {
            const daylight_oracle::Air air =
                daylight_oracle::make_air(wavelength(i), atmosphere.visibility, 0.8, 0.94, 1.2, kOzone[i] * 1e-27, 0.2);
            return std::exp(-air.rayleigh * columns.air - air.haze * columns.haze - air.ozone * columns.ozone);
        };
        const Bands bands = glm::exp(-medium.full().depth(columns));
        check_close(colour_of_rgb(to_rgb(bands)), colour_of_spectrum(spectrum), 0.008, 0.015);
    }
}

TEST_CASE("the sky has its spectrum's colour at sunset and at twilight") {
    Atmosphere atmosphere;
    atmosphere.haze_forward = 0.0;
    const AirLight light(atmosphere, 0, ScatteredLight::Rest::kNone);
    const glm::dvec3 directions[] = {{0, 1, 0}, {0.995, 0.1, 0}, {-0.995, 0.1, 0}, {0, 0.3, 0.954}};
    for (const double elevation : {3.0, -3.0}) {
        const double e = elevation / 180.0 * std::numbers::pi;
        const glm::dvec3 sun(std::cos(e), std::sin(e), 0.0);
        std::array<std::array<double, kSamples>, 4> seen{};
        for (int i = 0; i < kSamples; ++i) {
            const daylight_oracle::Oracle oracle(
                daylight_oracle::make_air(wavelength(i), atmosphere.visibility, 0.0, 0.94, 1.2, kOzone[i] * 1e-27, 0.2),
                sun);
            for (int d = 0; d < 4; ++d)
                seen[d][i] = oracle.single({0, daylight_oracle::kEarth, 0}, glm::normalize(directions[d]), 0.05);
        }
        for (int d = 0; d < 4; ++d) {
            CAPTURE(elevation);
            CAPTURE(d);
            const glm::dvec3 to = glm::normalize(directions[d]);
            const double cosine = glm::dot(to, sun);
            const Bands bands = light.total(light.of_sky(0.0, to.y, sun.y, cosine), cosine);
            check_close(colour_of_rgb(to_rgb(bands)), colour_of_spectrum([&](int i) { return seen[d][i]; }), 0.012,
                        0.03);
        }
    }
}
