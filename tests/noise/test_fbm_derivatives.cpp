#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "noise/bounds.h"
#include "noise/fbm.h"
#include "noise/float_error.h"
#include "noise/noise.h"
#include "tests/noise/batch_case.h"
#include "tests/noise/oracle_jet.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

constexpr double kRounding = 0x1p-24;

// By all three entry points, whose values and gradients must be the same bits.
template <std::size_t D>
Output<D> evaluate_fbm(std::span<const Octave> octaves, const std::array<double, D>& origin,
                       const Offsets<D>& offsets) {
    const std::size_t count = offsets[0].size();
    std::array<std::span<const float>, D> at;
    Output<D> full(count), slopes(count), values(count);
    GradientSpans<D> full_gradient, slopes_gradient;
    HessianSpans<D> full_hessian;
    for (std::size_t a = 0; a < D; ++a) {
        at[a] = offsets[a];
        full_gradient.axis[a] = unguarded(full.gradient[a]);
        slopes_gradient.axis[a] = unguarded(slopes.gradient[a]);
    }
    for (std::size_t e = 0; e < full.hessian.size(); ++e) full_hessian.entry[e] = unguarded(full.hessian[e]);
    fbm_hessian(octaves, origin, at, unguarded(full.value), full_gradient, full_hessian);
    fbm_gradient(octaves, origin, at, unguarded(slopes.value), slopes_gradient);
    fbm_value(octaves, origin, at, unguarded(values.value));
    CHECK(full.guarded());
    CHECK(slopes.guarded());
    CHECK(values.guarded());
    CHECK(values.value == full.value);
    CHECK(slopes.value == full.value);
    CHECK(slopes.gradient == full.gradient);
    return full;
}

// Exact values and what float may add to them, for the value, each slope and each second derivative.
template <std::size_t D>
struct Expected {
    Dual2<D> jet;
    std::array<double, 3> error{};
};

// Of an octave: its own roundings, those of its place (3 |w offset| + 2 roundings a cell and axis, against the next
// derivative), and of its factor and the sum.
template <std::size_t D>
Expected<D> expected_jet(std::span<const Octave> octaves, const std::array<double, D>& origin,
                         const Offsets<D>& offsets, std::size_t i) {
    const NoiseBounds& bounds = kNoiseBounds<D>;
    const FloatErrors& errors = kFloatErrors<D>;
    const std::array<double, 4> largest = {bounds.value, bounds.gradient, bounds.second, bounds.third};
    const std::array<double, 3> own = {errors.value, errors.gradient_axis, errors.hessian_entry};
    Expected<D> sum;
    for (const Octave& octave : octaves) {
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
        const Dual2<D> jet = oracle_jet_at<D>(octave.key.axis, cell, x);
        const auto w = static_cast<long double>(octave.frequency);
        const auto amplitude = static_cast<long double>(octave.amplitude);
        sum.jet.value += amplitude * jet.value;
        for (std::size_t a = 0; a < D; ++a) {
            sum.jet.gradient[a] += amplitude * w * jet.gradient[a];
            for (std::size_t b = 0; b < D; ++b) sum.jet.hessian[a][b] += amplitude * w * w * jet.hessian[a][b];
        }
        double factor = std::abs(octave.amplitude);
        for (std::size_t order = 0; order < 3; ++order, factor *= octave.frequency) {
            const double roundings = kRounding * static_cast<double>(2 * octaves.size() + 1) * largest[order];
            sum.error[order] += factor * (own[order] + largest[order + 1] * std::sqrt(shift) + roundings);
        }
    }
    return sum;
}

template <std::size_t D>
std::array<double, 3> worst_of_bounds(const Expected<D>& expected, const Output<D>& found, std::size_t i) {
    std::array<double, 3> worst{};
    const auto weigh = [&](std::size_t order, long double exact, float value) {
        const long double error = std::abs(static_cast<long double>(value) - exact);
        worst[order] = std::max(worst[order], static_cast<double>(error) / expected.error[order]);
    };
    weigh(0, expected.jet.value, found.value[i]);
    for (std::size_t a = 0; a < D; ++a) {
        weigh(1, expected.jet.gradient[a], found.gradient[a][i]);
        for (std::size_t b = a; b < D; ++b) weigh(2, expected.jet.hessian[a][b], found.hessian[entry<D>(a, b)][i]);
    }
    return worst;
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
    {"around 2^31 cells", {.octaves = 3, .frequency = 0x1p31}, 1.0, 1e-6f},
    {"32 octaves", {.octaves = 32, .lacunarity = 1.7, .gain = 0.7}, 1.0, 0.1f},
    {"lacunarity 10", {.octaves = 12, .lacunarity = 10.0, .gain = 0.3}, 1.0, 1e-6f},
};

template <std::size_t D>
void check_derivatives() {
    for_each_target([&](const std::string& target) {
        std::array<double, 3> slack{};
        for (const Setting& setting : kSettings) {
            std::mt19937_64 random(D);
            std::uniform_real_distribution<double> away(-setting.origin, setting.origin);
            std::uniform_real_distribution<float> near(-setting.reach, setting.reach);
            const std::vector<Octave> octaves = make_octaves(setting.parameters);
            for (const std::size_t count : {0, 1, 7, 16, 61}) {
                std::array<double, D> origin{};
                std::ranges::generate(origin, [&] { return away(random); });
                Offsets<D> offsets;
                for (auto& axis : offsets) {
                    for (std::size_t i = 0; i < count; ++i) axis.push_back(i % 7 == 0 ? 0.0f : near(random));
                }
                const Output<D> found = evaluate_fbm<D>(octaves, origin, offsets);
                for (std::size_t i = 0; i < count; ++i) {
                    const auto worst = worst_of_bounds<D>(expected_jet<D>(octaves, origin, offsets, i), found, i);
                    for (std::size_t order = 0; order < 3; ++order) slack[order] = std::max(slack[order], worst[order]);
                }
            }
        }
        for (const double largest : slack) CHECK(largest <= 1.0);
        MESSAGE(D << "-D " << target << ": largest errors, of their bounds: value " << slack[0] << ", slope "
                  << slack[1] << ", second " << slack[2]);
    });
}

}  // namespace

TEST_CASE("derivatives of fBm are those of the oracle's sum, and its values the same bits, on every SIMD target") {
    check_derivatives<2>();
    check_derivatives<3>();
}
