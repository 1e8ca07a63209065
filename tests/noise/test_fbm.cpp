#include "noise/fbm.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "noise/bounds.h"
#include "noise/float_error.h"
#include "noise/noise.h"
#include "tests/noise/oracle_jet.h"
#include "tools/stability/oracles/field_oracle.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;
using strata::oracle::OracleOctave;

template <std::size_t D>
using Offsets = std::array<std::vector<float>, D>;

constexpr double kRounding = 0x1p-24;

template <std::size_t D>
std::vector<float> evaluate(std::span<const Octave> octaves, const std::array<double, D>& origin,
                            const Offsets<D>& offsets) {
    std::array<std::span<const float>, D> spans;
    for (std::size_t a = 0; a < D; ++a) spans[a] = offsets[a];
    std::vector<float> value(offsets[0].size());
    fbm_value(octaves, origin, spans, value);
    return value;
}

template <std::size_t D>
Offsets<D> random_offsets(std::size_t count, float scale, std::mt19937_64& random) {
    std::uniform_real_distribution<float> uniform(-scale, scale);
    Offsets<D> offsets;
    for (auto& axis : offsets) {
        for (std::size_t i = 0; i < count; ++i) axis.push_back(i % 7 == 0 ? 0.0f : uniform(random));
    }
    return offsets;
}

std::vector<OracleOctave> oracle_octaves(const FbmParameters& p) {
    strata::oracle::Shape shape;
    shape.octaves = p.octaves;
    shape.lacunarity = p.lacunarity;
    shape.gain = p.gain;
    shape.amplitude = p.amplitude;
    shape.frequency = p.frequency;
    shape.seed = p.seed;
    return strata::oracle::FieldOracle(shape).octaves();
}

struct Expected {
    long double value = 0;
    double error = 0.0;  // bound of the float evaluation's
};

// The octave's position at the origin is rounded to double by definition; offsets add exactly. In cells, with w the
// frequency: rounding w and the fraction to float and adding up err by at most 2^-24 (3 |w offset| + 2) an axis.
template <std::size_t D>
Expected expected_value(const std::vector<OracleOctave>& octaves, const std::array<double, D>& origin,
                        const Offsets<D>& offsets, std::size_t i) {
    Expected sum;
    double roundings = 0.0;
    for (const OracleOctave& octave : octaves) {
        std::array<std::int64_t, D> cell;
        std::array<long double, D> x;
        double shift = 0.0;
        for (std::size_t a = 0; a < D; ++a) {
            const double start = octave.frequency * origin[a] + octave.offset[a];
            const long double step =
                static_cast<long double>(octave.frequency) * static_cast<long double>(offsets[a][i]);
            cell[a] = static_cast<std::int64_t>(std::floor(start));
            x[a] = static_cast<long double>(start - std::floor(start)) + step;
            shift += std::pow(kRounding * (3.0 * std::abs(static_cast<double>(step)) + 2.0), 2);
        }
        const auto amplitude = static_cast<long double>(octave.amplitude);
        sum.value += amplitude * oracle_jet_at<D>(octave.key, cell, x).value;
        const NoiseBounds& bounds = kNoiseBounds<D>;
        sum.error += std::abs(octave.amplitude) * (kFloatErrors<D>.value + bounds.gradient * std::sqrt(shift));
        roundings += std::abs(octave.amplitude) * bounds.value;
    }
    sum.error += kRounding * static_cast<double>(2 * octaves.size() + 1) * roundings;
    return sum;
}

struct Setting {
    const char* name;
    FbmParameters parameters;
    double origin;  // origins are drawn up to this far on each axis
    float reach;    // and offsets up to this far
};

const std::vector<Setting> kSettings = {
    {"plain", {}, 100.0, 4.0f},
    {"one octave", {.octaves = 1}, 1e3, 100.0f},
    {"2^20 away", {.octaves = 12}, 0x1p20, 0.5f},
    {"2^38 away", {.octaves = 14}, 0x1p38, 0.01f},
    {"around 2^31 cells", {.octaves = 3, .frequency = 0x1p31}, 1.0, 1e-6f},
    {"2^51 cells away", {.octaves = 1, .frequency = 1e9}, 0x1p51 / 1e9, 1e-8f},
    {"32 octaves", {.octaves = 32, .lacunarity = 1.7, .gain = 0.7}, 1.0, 0.1f},
    {"32 octaves of one frequency", {.octaves = 32, .lacunarity = 1.0, .gain = 1.0}, 100.0, 4.0f},
    {"lacunarity just above 1", {.octaves = 16, .lacunarity = 1.0001}, 100.0, 4.0f},
    {"lacunarity 10", {.octaves = 12, .lacunarity = 10.0, .gain = 0.3}, 1.0, 1e-6f},
    {"gain 0", {.octaves = 5, .gain = 0.0}, 100.0, 4.0f},
    {"amplitude 1e6, frequency 1e-9", {.amplitude = 1e6, .frequency = 1e-9, .seed = ~std::uint64_t{0}}, 1e9, 1e8f},
};

template <std::size_t D>
void check_sum() {
    constexpr std::size_t kCount = 61, kOrigins = 6;
    for_each_target([&](const std::string& target) {
        double slack = 0.0;
        std::string worst;
        for (const Setting& setting : kSettings) {
            std::mt19937_64 random(D);
            std::uniform_real_distribution<double> away(-setting.origin, setting.origin);
            const std::vector<Octave> octaves = make_octaves(setting.parameters);
            const std::vector<OracleOctave> oracle = oracle_octaves(setting.parameters);
            for (std::size_t trial = 0; trial < kOrigins; ++trial) {
                std::array<double, D> origin{};
                if (trial > 0) std::generate(origin.begin(), origin.end(), [&] { return away(random); });
                const Offsets<D> offsets = random_offsets<D>(kCount, setting.reach, random);
                const std::vector<float> found = evaluate<D>(octaves, origin, offsets);
                for (std::size_t i = 0; i < kCount; ++i) {
                    const Expected expected = expected_value<D>(oracle, origin, offsets, i);
                    const auto error =
                        std::abs(static_cast<double>(static_cast<long double>(found[i]) - expected.value));
                    if (error / expected.error > slack) slack = error / expected.error, worst = setting.name;
                }
            }
        }
        CHECK(slack <= 1.0);
        MESSAGE(D << "-D " << target << ": largest error " << slack << " of the bound, " << worst);
    });
}

// Values of one octave at random places of its own lattice.
std::vector<float> own_values(const Octave& octave, const Offsets<3>& offsets) {
    Octave plain = octave;
    plain.frequency = plain.amplitude = 1.0;
    return evaluate<3>(std::span(&plain, 1), {}, offsets);
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
    double aa = 0.0, bb = 0.0, ab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
        aa += x * x, bb += y * y, ab += x * y;
    }
    return ab / std::sqrt(aa * bb);
}

}  // namespace

TEST_CASE("fBm is the oracle's sum of octaves, near and far, on every SIMD target") {
    check_sum<2>();
    check_sum<3>();
}

TEST_CASE("octaves have the oracle's amplitudes, frequencies, offsets and keys") {
    for (const Setting& setting : kSettings) {
        const std::vector<Octave> octaves = make_octaves(setting.parameters);
        const std::vector<OracleOctave> oracle = oracle_octaves(setting.parameters);
        REQUIRE(octaves.size() == oracle.size());
        for (std::size_t k = 0; k < octaves.size(); ++k) {
            CHECK(octaves[k].amplitude == oracle[k].amplitude);
            CHECK(octaves[k].frequency == oracle[k].frequency);
            CHECK(octaves[k].offset == oracle[k].offset);
            CHECK(octaves[k].key.axis == oracle[k].key);
        }
    }
}

TEST_CASE("sub-spans of octaves add up to the whole") {
    std::mt19937_64 random(3);
    const std::vector<Octave> octaves = make_octaves({.octaves = 10});
    const Offsets<3> offsets = random_offsets<3>(200, 4.0f, random);
    const std::array<double, 3> origin = {1e4, -3.0, 0.1};
    const std::vector<float> whole = evaluate<3>(octaves, origin, offsets);
    double worst = 0.0;
    for (std::size_t split = 0; split <= octaves.size(); ++split) {
        const std::vector<float> coarse = evaluate<3>(std::span(octaves).first(split), origin, offsets);
        const std::vector<float> fine = evaluate<3>(std::span(octaves).subspan(split), origin, offsets);
        for (std::size_t i = 0; i < whole.size(); ++i) {
            worst = std::max(worst, std::abs(static_cast<double>(coarse[i] + fine[i] - whole[i])));
        }
    }
    // Each of 21 roundings is at most 2^-24 of the amplitudes' sum, 2.
    CHECK(worst <= 21 * 2.0 * kNoiseBounds<3>.value * kRounding);
}

TEST_CASE("octaves of zero amplitude change no bit") {
    std::mt19937_64 random(4);
    const Offsets<3> offsets = random_offsets<3>(200, 4.0f, random);
    const std::array<double, 3> origin = {0.3, 0.9, 0.1};
    const std::vector<float> first = evaluate<3>(make_octaves({.octaves = 1}), origin, offsets);
    CHECK(evaluate<3>(make_octaves({.octaves = 32, .gain = 0.0}), origin, offsets) == first);
    const std::vector<float> nothing(200, 0.0f);
    CHECK(evaluate<3>(make_octaves({.octaves = 32, .amplitude = 0.0}), origin, offsets) == nothing);
    CHECK(evaluate<3>({}, origin, offsets) == nothing);
}

TEST_CASE("octaves do not line up at the origin or anywhere in their lattices") {
    constexpr std::size_t kCount = 4096;
    std::mt19937_64 random(5);
    const std::vector<Octave> octaves = make_octaves({.octaves = kMaxOctaves});
    std::uniform_real_distribution<float> uniform(-4096.0f, 4096.0f);
    Offsets<3> offsets;
    for (auto& axis : offsets) std::generate_n(std::back_inserter(axis), kCount, [&] { return uniform(random); });
    std::vector<std::vector<float>> values;
    std::vector<float> at_origin;
    for (const Octave& octave : octaves) {
        values.push_back(own_values(octave, offsets));
        at_origin.push_back(evaluate<3>(std::span(&octave, 1), {}, {{{0.0f}, {0.0f}, {0.0f}}})[0] /
                            static_cast<float>(octave.amplitude));
    }
    std::sort(at_origin.begin(), at_origin.end());
    CHECK(std::adjacent_find(at_origin.begin(), at_origin.end()) == at_origin.end());
    CHECK(at_origin.front() < -0.1f);
    CHECK(at_origin.back() > 0.1f);
    // Independent values correlate by 1 / sqrt(count); 496 pairs reach 6 of these once in 10^6 runs.
    double worst = 0.0;
    for (std::size_t j = 0; j < octaves.size(); ++j) {
        for (std::size_t k = 0; k < j; ++k) worst = std::max(worst, std::abs(correlation(values[j], values[k])));
    }
    MESSAGE("largest correlation of two octaves " << worst);
    CHECK(worst < 6.0 / std::sqrt(static_cast<double>(kCount)));
}
