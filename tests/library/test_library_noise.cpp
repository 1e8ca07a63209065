#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "src/noise.h"
#include "tests/noise/batch_case.h"
#include "tests/noise/oracle_jet.h"
#include "tools/stability/oracles/field_oracle.h"

namespace {

using strata::Fbm;
using strata::FbmParameters;
using strata::Noise;
using strata::noise::test::all_targets;
using strata::noise::test::entry;
using strata::oracle::Dual2;
using strata::oracle::oracle_jet_at;
using strata::oracle::OracleOctave;

template <std::size_t D>
using Offsets = std::array<std::vector<float>, D>;

template <std::size_t D>
std::array<std::span<const float>, D> spans_of(const Offsets<D>& offsets) {
    std::array<std::span<const float>, D> spans;
    for (std::size_t a = 0; a < D; ++a) spans[a] = offsets[a];
    return spans;
}

// Places for all that a batch gives.
template <std::size_t D>
struct Results {
    std::vector<float> value;
    Offsets<D> slope;
    std::array<std::vector<float>, D*(D + 1) / 2> second;
    strata::Gradients<D> gradient;
    strata::Hessians<D> hessian;

    explicit Results(std::size_t count) : value(count) {
        for (std::size_t a = 0; a < D; ++a) gradient.axis[a] = slope[a] = std::vector<float>(count);
        for (std::size_t e = 0; e < second.size(); ++e) hessian.entry[e] = second[e] = std::vector<float>(count);
    }
};

template <std::size_t D>
Offsets<D> random_offsets(std::size_t count, float reach, std::mt19937_64& random) {
    std::uniform_real_distribution<float> uniform(-reach, reach);
    Offsets<D> offsets;
    for (auto& axis : offsets) {
        for (std::size_t i = 0; i < count; ++i) axis.push_back(uniform(random));
    }
    return offsets;
}

// The largest errors of a value, a slope and a second derivative, as parts of a certificate.
struct Slack {
    std::array<double, 3> of_bound{};

    void add(std::size_t order, long double exact, float found, double bound) {
        const auto error = static_cast<double>(std::abs(static_cast<long double>(found) - exact));
        of_bound[order] = std::max(of_bound[order], error / bound);
    }

    template <std::size_t D>
    void add_point(const Dual2<D>& exact, const Results<D>& found, std::size_t i, const strata::Rounding& bound) {
        add(0, exact.value, found.value[i], bound.value);
        for (std::size_t a = 0; a < D; ++a) {
            add(1, exact.gradient[a], found.slope[a][i], bound.gradient);
            for (std::size_t b = a; b < D; ++b) {
                add(2, exact.hessian[a][b], found.second[entry<D>(a, b)][i], bound.hessian);
            }
        }
    }

    void check(const std::string& what) const {
        for (const double part : of_bound) CHECK(part <= 1.0);
        MESSAGE(what << ": largest errors, of their certificates: value " << of_bound[0] << ", slope " << of_bound[1]
                     << ", second " << of_bound[2]);
    }
};

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

// The octaves' sum at origin + offset, all places in long double.
template <std::size_t D>
Dual2<D> oracle_sum(const std::vector<OracleOctave>& octaves, const std::array<double, D>& origin,
                    const Offsets<D>& offsets, std::size_t i) {
    Dual2<D> sum;
    for (const OracleOctave& octave : octaves) {
        const auto w = static_cast<long double>(octave.frequency), a = static_cast<long double>(octave.amplitude);
        std::array<long double, D> x;
        for (std::size_t axis = 0; axis < D; ++axis) {
            x[axis] = w * (static_cast<long double>(origin[axis]) + static_cast<long double>(offsets[axis][i])) +
                      static_cast<long double>(octave.offset[axis]);
        }
        const Dual2<D> jet = oracle_jet_at<D>(octave.key, {}, x);
        sum.value += a * jet.value;
        for (std::size_t j = 0; j < D; ++j) {
            sum.gradient[j] += a * w * jet.gradient[j];
            for (std::size_t k = 0; k < D; ++k) sum.hessian[j][k] += a * w * w * jet.hessian[j][k];
        }
    }
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
    {"far away in double", {.octaves = 2}, 0x1p44, 0.0f},
    {"far away in float", {.octaves = 3}, 1.0, 1e5f},
    {"32 octaves", {.octaves = 32, .lacunarity = 1.7, .gain = 0.7, .seed = 9}, 1.0, 0.1f},
    {"negative amplitude and gain", {.gain = -0.6, .amplitude = -3.0}, 10.0, 1.0f},
    {"amplitudes below float", {.octaves = 3, .amplitude = 1e-45, .frequency = 1e-3}, 1e3, 1e3f},
};

template <std::size_t D>
void check_certificates() {
    constexpr std::size_t kCount = 203;
    for (const std::string& target : all_targets()) {
        strata::use_simd_target(target);
        CHECK(strata::simd_target() == target);
        for (const Setting& setting : kSettings) {
            std::mt19937_64 random(D);
            std::uniform_real_distribution<double> away(-setting.origin, setting.origin);
            std::array<double, D> origin;
            std::ranges::generate(origin, [&] { return away(random); });
            const Offsets<D> offsets = random_offsets<D>(kCount, setting.reach, random);
            const Fbm<D> fbm(setting.parameters);
            Results<D> found(kCount);
            fbm.hessians({origin, spans_of(offsets)}, found.value, found.gradient, found.hessian);
            const strata::Rounding rounding = fbm.rounding(setting.origin, static_cast<double>(setting.reach));
            const std::vector<OracleOctave> octaves = oracle_octaves(setting.parameters);
            Slack slack;
            for (std::size_t i = 0; i < kCount; ++i) {
                slack.add_point<D>(oracle_sum<D>(octaves, origin, offsets, i), found, i, rounding);
            }
            slack.check(std::to_string(D) + "-D " + target + ", " + setting.name);
        }
    }
    strata::use_simd_target(all_targets().front());
}

// The largest value and slope of many points come near what is certified: for one octave, whose certificate is sharp.
template <std::size_t D>
void check_bounds() {
    constexpr std::size_t kCount = 400000;
    std::mt19937_64 random(D);
    const Offsets<D> offsets = random_offsets<D>(kCount, 1000.0f, random);
    for (const int octaves : {1, 6}) {
        const Fbm<D> fbm({.octaves = octaves, .amplitude = -2.0, .frequency = 3.0});
        std::vector<float> value(kCount);
        Offsets<D> slope;
        strata::Gradients<D> gradient;
        for (std::size_t a = 0; a < D; ++a) gradient.axis[a] = slope[a] = std::vector<float>(kCount);
        fbm.gradients({{}, spans_of(offsets)}, value, gradient);
        double largest_value = 0.0, largest_slope = 0.0;
        for (std::size_t i = 0; i < kCount; ++i) {
            double squared = 0.0;
            for (std::size_t a = 0; a < D; ++a) squared += std::pow(static_cast<double>(slope[a][i]), 2);
            largest_slope = std::max(largest_slope, std::sqrt(squared));
            largest_value = std::max(largest_value, std::abs(static_cast<double>(value[i])));
        }
        const strata::Bounds bounds = fbm.bounds();
        CHECK(largest_value <= bounds.value);
        CHECK(largest_slope <= bounds.gradient);
        if (octaves == 1) CHECK(largest_value > 0.8 * bounds.value);
        if (octaves == 1) CHECK(largest_slope > 0.8 * bounds.gradient);
        MESSAGE(D << "-D, " << octaves << " octaves, of the bounds: value " << largest_value / bounds.value
                  << ", gradient " << largest_slope / bounds.gradient);
    }
}

template <std::size_t D>
void check_noise() {
    constexpr std::size_t kCount = 77;
    std::mt19937_64 random(D);
    const Offsets<D> offsets = random_offsets<D>(kCount, 5.0f, random);
    const strata::NoisePoints<D> points{{std::int64_t{1} << 40, -3}, spans_of(offsets)};
    const std::array<std::uint32_t, 3> key = strata::noise::lattice_key(5, 0).axis;
    const Noise<D> noise(5);
    Results<D> found(kCount), slopes(kCount), values(kCount);
    noise.hessians(points, found.value, found.gradient, found.hessian);
    noise.gradients(points, slopes.value, slopes.gradient);
    noise.values(points, values.value);
    CHECK(found.value == values.value);
    CHECK(found.value == slopes.value);
    CHECK(found.slope == slopes.slope);
    Slack slack;
    for (std::size_t i = 0; i < kCount; ++i) {
        std::array<long double, D> x;
        for (std::size_t a = 0; a < D; ++a) x[a] = static_cast<long double>(offsets[a][i]);
        slack.add_point<D>(oracle_jet_at<D>(key, points.cell, x), found, i, Noise<D>::rounding());
    }
    slack.check(std::to_string(D) + "-D noise");
    for (std::size_t i = 0; i < kCount; ++i) {
        CHECK(std::abs(static_cast<double>(found.value[i])) <= Noise<D>::bounds().value);
    }
}

}  // namespace

TEST_CASE("fBm and its derivatives are the exact sum's within their certificate, on every SIMD target") {
    check_certificates<2>();
    check_certificates<3>();
}

TEST_CASE("no value or slope exceeds its bound, and those of one octave come near it") {
    check_bounds<2>();
    check_bounds<3>();
}

TEST_CASE("noise and its derivatives are the oracle's within their certificate") {
    check_noise<2>();
    check_noise<3>();
}

TEST_CASE("a point that is out of range spoils no other, on every SIMD target") {
    for (const std::string& target : all_targets()) {
        strata::use_simd_target(target);
        const Fbm<2> fbm;
        std::vector<float> x(40, 0.25f), y(40, 0.75f), whole(40), spoilt(40);
        fbm.values({{}, {x, y}}, whole);
        const std::array<float, 4> wrong = {std::nanf(""), INFINITY, 1e30f, -1e30f};
        for (std::size_t i = 0; i < wrong.size(); ++i) x[3 * i + 1] = wrong[i];
        fbm.values({{}, {x, y}}, spoilt);
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (x[i] == 0.25f) CHECK(spoilt[i] == whole[i]);
        }
    }
    strata::use_simd_target(all_targets().front());
}

TEST_CASE("an fBm is a value: copies and moved ones give the same sums") {
    const std::vector<float> at = {0.5f, 1.25f};
    std::vector<float> first(2), second(2);
    Fbm<2> fbm({.seed = 7});
    const Fbm<2> copy = fbm;
    fbm.values({{}, {at, at}}, first);
    copy.values({{}, {at, at}}, second);
    CHECK(first == second);
    CHECK(copy.parameters().seed == 7);
    fbm = Fbm<2>({.seed = 8});
    fbm.values({{}, {at, at}}, second);
    CHECK(first != second);
}
