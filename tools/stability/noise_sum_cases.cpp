// Sums of up to 32 octaves on every SIMD target against long double.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "noise/bounds.h"
#include "noise/float_error.h"
#include "noise/noise.h"
#include "noise/simd_target.h"
#include "tools/stability/case.h"
#include "tools/stability/oracles/noise_oracle.h"

namespace strata::tools::stability {

namespace {

struct Sum {
    const char* name;
    noise::FbmParameters parameters;
    double origin;  // each coordinate's size
    float reach;    // of the float offsets
};

// Frequencies stay below 2^50 cells within reach, as scenes must.
const std::array<Sum, 8> kSums = {{
    {"32 octaves, gain 1/2, lacunarity 2", {.octaves = 32}, 1.0, 0x1p-9f},
    {"32 octaves, gain 1, lacunarity 1", {.octaves = 32, .lacunarity = 1.0, .gain = 1.0}, 100.0, 1.0f},
    {"32 octaves, gain 1, lacunarity 1.0001", {.octaves = 32, .lacunarity = 1.0001, .gain = 1.0}, 100.0, 1.0f},
    {"32 octaves, gain 1, lacunarity 2", {.octaves = 32, .lacunarity = 2.0, .gain = 1.0}, 1.0, 0x1p-9f},
    {"15 octaves, gain 1/2, lacunarity 10", {.octaves = 15, .lacunarity = 10.0}, 1.0, 1e-8f},
    {"15 octaves, gain 1, lacunarity 10", {.octaves = 15, .lacunarity = 10.0, .gain = 1.0}, 1.0, 1e-8f},
    {"32 octaves, gain 0", {.octaves = 32, .gain = 0.0}, 1.0, 0x1p-9f},
    {"1 octave, 2^40 cells away", {.octaves = 1, .frequency = 1024.0}, 0x1p30, 1e-3f},
}};

// fbm_value's contract: the position is off by 2^-24 (3 |w offset| + 2) cells an axis, worth the gradient's bound a
// cell; each octave errs by kFloatErrors3.value; each of 2 K + 1 roundings of the sum by 2^-24 of its amplitudes. The
// octave's position at the origin is rounded to double by definition (2^-53 of its size, twice), as it is in the long
// double sum here.
std::vector<Row> sums(const Settings& settings, Random& random, const std::string& target) {
    std::vector<Row> rows;
    for (const Sum& sum : kSums) {
        const std::vector<noise::Octave> octaves = noise::make_octaves(sum.parameters);
        Worst worst;
        double largest = 0.0;
        for (int i = 0; i < settings.trials(300, 30); ++i) {
            std::uniform_real_distribution<double> unit(-1.0, 1.0);
            std::array<double, 3> origin;
            std::array<float, 3> offset;
            for (std::size_t a = 0; a < 3; ++a) {
                origin[a] = sum.origin * unit(random);
                offset[a] = sum.reach * static_cast<float>(unit(random));
            }
            float found = 0.0f;
            noise::fbm_value(octaves, origin,
                             {std::span(&offset[0], 1), std::span(&offset[1], 1), std::span(&offset[2], 1)},
                             std::span(&found, 1));
            long double expected = 0.0L, amplitudes = 0.0L, bound = 0.0L;
            for (const noise::Octave& octave : octaves) {
                std::array<long double, 3> p;
                long double shift = 0.0L;
                for (std::size_t a = 0; a < 3; ++a) {
                    const double at = octave.frequency * origin[a] + octave.offset[a];
                    const long double step =
                        static_cast<long double>(octave.frequency) * static_cast<long double>(offset[a]);
                    p[a] = static_cast<long double>(at) + step;
                    const long double axis = 0x1p-24L * (3 * std::abs(step) + 2);
                    shift += axis * axis;
                }
                const long double amplitude = static_cast<long double>(octave.amplitude);
                expected += amplitude * oracle::noise3<long double>(octave.key.axis, p[0], p[1], p[2]);
                bound += amplitude * (static_cast<long double>(noise::kFloatErrors3.value) +
                                      static_cast<long double>(noise::kBounds3.gradient) * std::sqrt(shift));
                amplitudes += amplitude * static_cast<long double>(noise::kBounds3.value);
            }
            bound += 0x1p-24L * static_cast<long double>(2 * octaves.size() + 1) * amplitudes;
            largest = std::max(largest, static_cast<double>(bound));
            worst.see(static_cast<double>(std::abs(static_cast<long double>(found) - expected) / bound), [&] {
                return fmt::format("origin {:.17g} {:.17g} {:.17g}, offset {:.9g} {:.9g} {:.9g}", origin[0], origin[1],
                                   origin[2], offset[0], offset[1], offset[2]);
            });
        }
        rows.push_back(check(fmt::format("{} 3-D sum of {}", target, sum.name), worst.value() * largest, largest,
                             "absolute", worst.where()));
    }
    return rows;
}

}  // namespace

void add_noise_sum_cases(std::vector<Case>& cases) {
    for (const std::string& target : noise::simd_targets()) {
        cases.push_back(
            {"noise", target + " sums", [=](const Settings& s, Random& r) { return sums(s, r, target); }, target});
    }
}

}  // namespace strata::tools::stability
