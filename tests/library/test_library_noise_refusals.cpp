#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "src/noise.h"
#include "tests/library/errors.h"

using strata::Fbm;
using strata::FbmParameters;
using strata::Noise;

namespace {

std::string refusal(const FbmParameters& parameters) {
    return message_of([&] { Fbm<2> fbm(parameters); });
}

}  // namespace

TEST_CASE("parameters out of range are refused by name") {
    check_says(refusal({.octaves = 0}), "octaves: out of range (0), allowed: 1 to 32");
    check_says(refusal({.octaves = 33}), "octaves: ");
    check_says(refusal({.lacunarity = -2.0}), "lacunarity: out of range (-2)");
    check_says(refusal({.frequency = 0.0}), "frequency: ");
    check_says(refusal({.gain = std::nan("")}), "gain: ");
    check_says(refusal({.amplitude = INFINITY}), "amplitude: ");
    check_says(refusal({.octaves = 32, .lacunarity = 10.0}), "octave 16: frequency: out of range (1e+16)");
    check_says(refusal({.octaves = 32, .lacunarity = 1.0, .gain = 100.0}), "octave 16: amplitude: out of range");
    CHECK(refusal({.octaves = 32, .lacunarity = 1.0, .gain = 0.0}) == "no error");
}

TEST_CASE("places too far and spans of unlike length are refused by name") {
    const Fbm<2> fbm({.octaves = 4});
    const std::vector<float> three(3), two(2);
    std::vector<float> value(3), short_value(2);
    const std::array<std::span<const float>, 2> good = {three, three}, uneven = {three, two};
    check_says(message_of([&] { fbm.values({{0.0, 0x1p48}, good}, value); }), "origin[1]: out of range");
    check_says(message_of([&] { fbm.values({{std::nan(""), 0.0}, good}, value); }), "origin[0]: ");
    CHECK(message_of([&] { fbm.values({{0.0, -0x1.ffp47}, good}, value); }) == "no error");
    check_says(message_of([&] { fbm.values({{}, uneven}, value); }), "offset[1]: 2 elements, allowed: as many");
    check_says(message_of([&] { fbm.values({{}, good}, short_value); }), "offset[0]: 3 elements");
    const strata::Gradients<2> gradient{{value, short_value}};
    check_says(message_of([&] { fbm.gradients({{}, good}, value, gradient); }), "axis[1]: 2 elements");
    const strata::Gradients<2> whole{{value, value}};
    const strata::Hessians<2> hessian{{value, value, short_value}};
    check_says(message_of([&] { Noise<2>().hessians({{}, good}, value, whole, hessian); }), "entry[2]: 2 elements");
    check_says(message_of([] { strata::use_simd_target("mmx"); }), "SIMD target 'mmx': ");
}
