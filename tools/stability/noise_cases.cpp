// Gradient noise on every SIMD target against long double, at lattice planes, edges and corners and far from the
// origin.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "noise/bounds.h"
#include "noise/float_error.h"
#include "noise/noise.h"
#include "noise/simd_target.h"
#include "tools/stability/case.h"
#include "tools/stability/oracles/noise_jet.h"

namespace strata::tools::stability {

namespace {

using noise::kFloatErrors;
using oracle::Dual2;

template <std::size_t D>
std::size_t entry(std::size_t i, std::size_t j) {
    if (i > j) std::swap(i, j);
    if constexpr (D == 2) return i + j;
    return i == j ? i : 2 + i + j;
}

// One point by the batch's widest entry.
template <std::size_t D>
struct Jet {
    float value = 0.0f;
    std::array<float, D> gradient{};
    std::array<float, D*(D + 1) / 2> hessian{};
};

template <std::size_t D>
Jet<D> evaluate(const noise::LatticeKey& key, const std::array<std::int64_t, D>& cell,
                const std::array<float, D>& offset) {
    Jet<D> jet;
    noise::Points<D> points{cell, {}};
    noise::GradientSpans<D> gradient;
    noise::HessianSpans<D> hessian;
    for (std::size_t a = 0; a < D; ++a) {
        points.offset[a] = std::span(&offset[a], 1);
        gradient.axis[a] = std::span(&jet.gradient[a], 1);
    }
    for (std::size_t e = 0; e < jet.hessian.size(); ++e) hessian.entry[e] = std::span(&jet.hessian[e], 1);
    noise::noise_hessian(key, points, std::span(&jet.value, 1), gradient, hessian);
    return jet;
}

struct Errors {
    double value = 0.0, slope = 0.0, hessian = 0.0;
};

template <std::size_t D>
Errors errors(const Jet<D>& found, const Dual2<D>& expected) {
    Errors e;
    e.value = static_cast<double>(std::abs(static_cast<long double>(found.value) - expected.value));
    long double squared = 0;
    for (std::size_t a = 0; a < D; ++a) {
        const long double slope = static_cast<long double>(found.gradient[a]) - expected.gradient[a];
        squared += slope * slope;
        for (std::size_t b = 0; b < D; ++b) {
            const long double bend = static_cast<long double>(found.hessian[entry<D>(a, b)]) - expected.hessian[a][b];
            e.hessian = std::max(e.hessian, static_cast<double>(std::abs(bend)));
        }
    }
    e.slope = static_cast<double>(std::sqrt(squared));
    if (std::isnan(found.value) || std::isnan(e.slope)) e.value = std::numeric_limits<double>::quiet_NaN();
    return e;
}

template <std::size_t D>
std::string place(const std::array<std::int64_t, D>& cell, const std::array<float, D>& offset, std::uint64_t seed) {
    std::string text = fmt::format("lattice seed {}, cell", seed);
    for (std::size_t a = 0; a < D; ++a) text += fmt::format(" {}{:+.9g}", cell[a], offset[a]);
    return text;
}

// Cells near 0, on both sides of every carry between an index's words, at +-2^40 and next to the range's end.
std::int64_t random_cell(Random& random, bool far) {
    const std::int64_t near = static_cast<std::int64_t>(random() % 9) - 4;
    if (!far) return near;
    constexpr std::array<std::int64_t, 6> kFar = {std::int64_t{1} << 31, std::int64_t{1} << 32,
                                                  std::int64_t{3} << 31, std::int64_t{1} << 33,
                                                  std::int64_t{1} << 40, (std::int64_t{1} << 51) - 64};
    const std::int64_t at = kFar[random() % kFar.size()];
    return (random() % 2 ? at : -at) + near;
}

// On a lattice plane, a float beside one, tiny, or anywhere; so that two or three axes make edges and corners.
float random_offset(Random& random) {
    const float sign = random() % 2 ? 1.0f : -1.0f, whole = static_cast<float>(random() % 3);
    switch (random() % 8) {
        case 0:
            return sign * whole;
        case 1:
            return std::nextafter(sign * whole, 9.0f);
        case 2:
            return std::nextafter(sign * whole, -9.0f);
        case 3:
            return sign * std::ldexp(1.0f, -static_cast<int>(random() % 149));
        default:
            return sign * std::uniform_real_distribution<float>(0.0f, 3.0f)(random);
    }
}

template <std::size_t D>
std::vector<Row> against_long_double(const Settings& settings, Random& random, const std::string& target) {
    std::array<Worst, 3> near, far;
    for (int i = 0; i < settings.trials(20000, 1500); ++i) {
        const bool is_far = i % 2 == 1;
        const std::uint64_t seed = random() % 1000;
        std::array<std::int64_t, D> cell;
        std::array<float, D> offset;
        std::array<long double, D> exact;
        for (std::size_t a = 0; a < D; ++a) {
            cell[a] = random_cell(random, is_far && (a == 0 || random() % 2));
            offset[a] = random_offset(random);
            exact[a] = static_cast<long double>(offset[a]);
        }
        const noise::LatticeKey key = noise::lattice_key(seed, 0);
        const Errors e = errors<D>(evaluate<D>(key, cell, offset), oracle::oracle_jet_at<D>(key.axis, cell, exact));
        std::array<Worst, 3>& worst = is_far ? far : near;
        const auto where = [&] { return place<D>(cell, offset, seed); };
        worst[0].see(e.value, where);
        worst[1].see(e.slope, where);
        worst[2].see(e.hessian, where);
    }
    std::vector<Row> rows;
    constexpr std::array<double, 3> kBounds = {kFloatErrors<D>.value, kFloatErrors<D>.slope,
                                               kFloatErrors<D>.hessian_entry};
    constexpr std::array<const char*, 3> kNames = {"value", "gradient", "Hessian"};
    for (const bool is_far : {false, true}) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Worst& worst = is_far ? far[i] : near[i];
            rows.push_back(
                check(fmt::format("{} {}-D {} {}", target, D, kNames[i],
                                  is_far ? "2^31 to 2^51 cells away, both signs" : "at planes, edges, corners"),
                      worst, kBounds[i], "absolute"));
        }
    }
    return rows;
}

// A point of a face, edge or corner, from the cells on both sides: twice the evaluation's error, and what exact
// arithmetic changes over the gap of 2^-24 between the floats on either side, by the next derivative's bound (the third
// exists on each side of a face).
template <std::size_t D>
std::vector<Row> continuity(const Settings& settings, Random& random, const std::string& target) {
    std::array<Worst, 3> jump;
    Worst corner;
    const noise::NoiseBounds& bounds = noise::kNoiseBounds<static_cast<int>(D)>;
    const double gap = 0x1p-24 * std::sqrt(static_cast<double>(D));
    const std::array<double, 3> bound = {2 * kFloatErrors<D>.value + bounds.gradient * gap,
                                         2 * kFloatErrors<D>.slope + D * bounds.second * gap,
                                         2 * kFloatErrors<D>.hessian_entry + D * bounds.third * gap};
    for (int i = 0; i < settings.trials(6000, 600); ++i) {
        const std::uint64_t seed = random() % 1000;
        const noise::LatticeKey key = noise::lattice_key(seed, 0);
        std::array<std::int64_t, D> cell;
        std::array<float, D> below, above;
        const std::size_t planes = 1 + random() % D;
        for (std::size_t a = 0; a < D; ++a) {
            cell[a] = random_cell(random, i % 2 == 1);
            const bool on_plane = a < planes;
            below[a] = above[a] = std::uniform_real_distribution<float>(0.0f, 1.0f)(random);
            if (on_plane) below[a] = -0x1p-24f, above[a] = 0.0f;
        }
        const Jet<D> left = evaluate<D>(key, cell, below), right = evaluate<D>(key, cell, above);
        const auto where = [&] { return place<D>(cell, below, seed); };
        jump[0].see(std::abs(static_cast<double>(left.value - right.value)) / bound[0], where);
        double squared = 0;
        for (std::size_t a = 0; a < D; ++a)
            squared += std::pow(static_cast<double>(left.gradient[a] - right.gradient[a]), 2);
        jump[1].see(std::sqrt(squared) / bound[1], where);
        for (std::size_t e = 0; e < left.hessian.size(); ++e) {
            jump[2].see(std::abs(static_cast<double>(left.hessian[e] - right.hessian[e])) / bound[2], where);
        }
        if (planes < D) continue;
        // In a corner every weight is 0 or 1 and every offset 0 or -1: no rounding at all.
        const Dual2<D> exact = oracle::oracle_jet<D>(key.axis, cell, {});
        double off = std::abs(static_cast<double>(right.value));
        for (std::size_t a = 0; a < D; ++a) {
            off = std::max(
                off, static_cast<double>(std::abs(static_cast<long double>(right.gradient[a]) - exact.gradient[a])));
        }
        corner.see(off, where);
    }
    std::vector<Row> rows;
    constexpr std::array<const char*, 3> kNames = {"value", "gradient", "Hessian"};
    for (std::size_t i = 0; i < 3; ++i) {
        rows.push_back(check(fmt::format("{} {}-D {}: jump across planes, edges, corners (C2)", target, D, kNames[i]),
                             jump[i].value() * bound[i], bound[i], "absolute", jump[i].where()));
    }
    rows.push_back(
        check(fmt::format("{} {}-D value 0 and corner's own gradient in corners", target, D), corner, 0.0, "absolute"));
    return rows;
}

// Where the gradient vanishes - found by Newton's iteration on the oracle - and along directions across it, relative
// errors mean nothing: the absolute bounds must hold, without NaN.
template <std::size_t D>
std::vector<Row> zero_gradients(const Settings& settings, Random& random, const std::string& target) {
    Worst slope, directional;
    int found = 0;
    for (int i = 0; i < settings.trials(3000, 300); ++i) {
        const std::uint64_t seed = random() % 1000;
        const noise::LatticeKey key = noise::lattice_key(seed, 0);
        std::array<std::int64_t, D> cell;
        std::array<long double, D> x;
        for (std::size_t a = 0; a < D; ++a) {
            cell[a] = random_cell(random, false);
            x[a] = std::uniform_real_distribution<double>(0.0, 1.0)(random);
        }
        Dual2<D> at = oracle::oracle_jet_at<D>(key.axis, cell, x);
        for (int step = 0; step < 12; ++step) {
            // Gauss-Seidel sweeps on the Hessian are enough: what does not converge is not used.
            for (std::size_t a = 0; a < D; ++a) {
                if (at.hessian[a][a] == 0.0L) break;
                const long double move = at.gradient[a] / at.hessian[a][a];
                if (std::abs(move) > 0.3L) break;
                x[a] -= move;
                at = oracle::oracle_jet_at<D>(key.axis, cell, x);
            }
        }
        std::array<float, D> offset;
        std::array<long double, D> exact;
        for (std::size_t a = 0; a < D; ++a) {
            offset[a] = static_cast<float>(x[a]);
            exact[a] = static_cast<long double>(offset[a]);
        }
        at = oracle::oracle_jet_at<D>(key.axis, cell, exact);
        long double size = 0.0L;
        for (const long double g : at.gradient) size += g * g;
        const Jet<D> jet = evaluate<D>(key, cell, offset);
        const auto where = [&] { return place<D>(cell, offset, seed); };
        directional.see(std::abs(static_cast<double>(static_cast<long double>(jet.gradient[0]) * at.gradient[1] -
                                                     static_cast<long double>(jet.gradient[1]) * at.gradient[0])) /
                            std::max(1e-30, static_cast<double>(std::hypot(at.gradient[0], at.gradient[1]))),
                        where);
        if (std::sqrt(size) > 1e-5L) continue;
        ++found;
        slope.see(errors<D>(jet, at).slope, where);
    }
    return {check(fmt::format("{} {}-D gradient where it vanishes", target, D), slope.value(), kFloatErrors<D>.slope,
                  "absolute", fmt::format("{} critical points; {}", found, slope.where())),
            check(fmt::format("{} {}-D slope along directions across the gradient", target, D), directional,
                  kFloatErrors<D>.slope, "absolute")};
}

}  // namespace

void add_noise_cases(std::vector<Case>& cases) {
    for (const std::string& target : noise::simd_targets()) {
        const auto add = [&](const std::string& name,
                             std::vector<Row> (*run)(const Settings&, Random&, const std::string&)) {
            cases.push_back({"noise", target + " " + name,
                             [=](const Settings& s, Random& r) { return run(s, r, target); }, target});
        };
        add("2-D", against_long_double<2>);
        add("3-D", against_long_double<3>);
        add("2-D continuity", continuity<2>);
        add("3-D continuity", continuity<3>);
        add("2-D zero gradients", zero_gradients<2>);
        add("3-D zero gradients", zero_gradients<3>);
    }
}

}  // namespace strata::tools::stability
