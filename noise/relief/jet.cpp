// The reference path of reliefs: their formulas, read with numbers in double that have gradients.
#include <array>
#include <utility>

#define STRATA_RELIEF_FORMULAS
#include <hwy/highway.h>

#include "noise/reference.h"
#include "noise/relief/frame.h"
#include "noise/relief/nodes/all.h"
#include "noise/relief/pits.h"
#include "noise/relief/relief.h"
#include "noise/relief/stripe.h"

namespace strata::noise {

namespace {

// Values with their gradients by the coordinates of the point where the relief is asked for.
class JetNumbers : public ReliefFrame {
  public:
    using Number = ReliefJet;
    using Displacement = std::array<Number, 3>;
    struct Domain {
        glm::dvec3 at;
        glm::dmat3 jacobian{1.0};  // of `at`, by columns
    };

    JetNumbers(std::span<const ReliefPart> parts, std::size_t index, int dimensions)
        : ReliefFrame(parts[index], dimensions), parts_(parts) {}

    static Number constant(double x) { return {x, glm::dvec3(0.0)}; }
    static Number plus(const Number& a, const Number& b) { return {a.value + b.value, a.gradient + b.gradient}; }
    static Number scaled(const Number& a, double by) { return {by * a.value, by * a.gradient}; }
    static Number product(const Number& a, const Number& b) {
        return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
    }
    static Number product_of_positive(const Number& a, const Number& b) { return product(a, b); }
    template <class Curve>
    static Number curved(const Curve& curve, const Number& a) {
        return {curve.value(a.value), curve.slope(a.value) * a.gradient};
    }

    Number octave(std::size_t k, const Domain& at) const {
        const PlanTurn* turn = ReliefFrame::turn(k);
        return turn == nullptr ? octave_of(part().octaves[k], at) : octave_of(part().octaves[k], turned(at, *turn));
    }
    Number octave(std::size_t k, const Domain& at, double by) const { return scaled(octave(k, at), by); }
    static Domain turned(const Domain& at, const PlanTurn& turn) {
        Domain there = at;
        there.at.x = turn.cosine * at.at.x + turn.sine * at.at.z;
        there.at.z = turn.cosine * at.at.z - turn.sine * at.at.x;
        for (int column = 0; column < 3; ++column) {
            const glm::dvec3& of = at.jacobian[column];
            there.jacobian[column].x = turn.cosine * of.x + turn.sine * of.z;
            there.jacobian[column].z = turn.cosine * of.z - turn.sine * of.x;
        }
        return there;
    }
    Number octave_of(const Octave& octave, const Domain& at) const {
        if (is_planar()) {
            const auto p = octave_position<2>(octave, {at.at.x, at.at.z});
            const auto jet = reference_jet<2>(octave.key, split_position<2>(p));
            const glm::dvec3 there{jet.gradient[0], 0.0, jet.gradient[1]};
            return {jet.value, octave.frequency * (there * at.jacobian)};
        }
        const auto p = octave_position<3>(octave, {at.at.x, at.at.y, at.at.z});
        const auto jet = reference_jet<3>(octave.key, split_position<3>(p));
        const glm::dvec3 there{jet.gradient[0], jet.gradient[1], jet.gradient[2]};
        return {jet.value, octave.frequency * (there * at.jacobian)};
    }

    static Number begin_sum() { return {}; }
    static bool sees(Number&, std::size_t, const Domain&, double, double) { return true; }
    static bool sees_stripe(Number&, std::size_t, const Domain&, double, double) { return true; }
    static bool sees_cells(Number&, double, const Domain&, double, double) { return true; }
    static bool sees_weighed(Number&, std::size_t, const Domain&, const Number&, double, double) { return true; }
    static void add(Number& sum, const Number& term) { sum = plus(sum, term); }
    static Number total(const Number& sum) { return sum; }

    static Displacement no_displacement() { return {}; }
    Domain displaced(const Domain& at, const Displacement& u) const {
        Domain there = at;
        for (int i = 0; i < static_cast<int>(dimensions()); ++i) {
            const int axis = is_planar() ? 2 * i : i;
            const Number& by = u[static_cast<std::size_t>(i)];
            there.at[axis] += by.value;
            for (int column = 0; column < 3; ++column) there.jacobian[column][axis] += by.gradient[column];
        }
        return there;
    }

    Domain shifted(const Domain& at, int i, double by) const {
        Domain there = at;
        there.at[is_planar() ? 2 * i : i] += by;
        return there;
    }

    using Pair = std::pair<Number, Number>;

    // x / R and y / R, R = sqrt(x^2 + y^2 + c^2).
    static Pair unit(const Number& x, const Number& y, double c) {
        const double r = std::sqrt(x.value * x.value + y.value * y.value + c * c);
        const glm::dvec3 turn = (x.value * x.gradient + y.value * y.gradient) / (r * r);
        return {{x.value / r, x.gradient / r - x.value / r * turn}, {y.value / r, y.gradient / r - y.value / r * turn}};
    }
    static Number norm(const Number& x, const Number& y, double c) {
        const double r = std::sqrt(x.value * x.value + y.value * y.value + c * c);
        return {r - c, (x.value * x.gradient + y.value * y.gradient) / r};
    }
    static Number part_of(const Number& whole, const Number& share) { return product(whole, share); }
    static Number mixed(const Number& a, const Number& b, const Number& share) {
        return plus(a, product(share, plus(b, scaled(a, -1.0))));
    }
    static Number highest(const Number& a, const Number& b, double softness) {
        const double d = a.value - b.value, r = std::sqrt(d * d + softness * softness), to_a = 0.5 + 0.5 * d / r;
        return {0.5 * (a.value + b.value + r), to_a * a.gradient + (1.0 - to_a) * b.gradient};
    }

    // per_x x + per_z z + offset; up to a whole number if that is all that matters.
    static Number along(const Domain& at, double per_x, double per_z, double offset, bool repeats) {
        const double value = at.at.x * per_x + at.at.z * per_z + offset;
        return {repeats ? value - std::floor(value) : value, glm::dvec3(per_x, 0.0, per_z) * at.jacobian};
    }

    Number fall_off(const Domain& at, double x, double z, double per_x, double per_z) const {
        const double u = (at.at.x - x) * per_x, v = (at.at.z - z) * per_z, one = 1.0 + u * u + v * v;
        const glm::dvec3 there = -4.0 / (one * one * one) * glm::dvec3(u * per_x, 0.0, v * per_z);
        return {1.0 / (one * one), there * at.jacobian};
    }

    Pair stripe(std::size_t k, const Domain& at, const Number& dx, const Number& dz, double bands) const {
        const Octave& octave = part().octaves[k];
        const auto p = split_position<2>(octave_position<2>(octave, {at.at.x, at.at.z}));
        const auto fade = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
        const auto fade_slope = [](double t) { return 30.0 * t * t * (t - 1.0) * (t - 1.0); };
        const double u = fade(p.fraction[0]), v = fade(p.fraction[1]);
        const double du = fade_slope(p.fraction[0]), dv = fade_slope(p.fraction[1]);
        const double wave = StripeBounds(bands).wave;
        Number c, s;
        for (unsigned corner = 0; corner < 4; ++corner) {
            const bool right = (corner & 1) != 0, up = (corner & 2) != 0;
            const double tx = p.fraction[0] - right, tz = p.fraction[1] - up;
            const double angle =
                wave * (dx.value * tx + dz.value * tz) + 2.0 * std::numbers::pi * phase_of(octave, p.cell, right, up);
            const double wx = right ? u : 1.0 - u, wz = up ? v : 1.0 - v, w = wx * wz;
            const double cosine = std::cos(angle), sine = std::sin(angle);
            const glm::dvec3 weight = octave.frequency * glm::dvec3((right ? du : -du) * wz, 0.0, (up ? dv : -dv) * wx);
            const glm::dvec3 place = octave.frequency * glm::dvec3(dx.value, 0.0, dz.value);
            const glm::dvec3 turn = wave * (place * at.jacobian + tx * dx.gradient + tz * dz.gradient);
            c.value += w * cosine;
            s.value += w * sine;
            c.gradient += cosine * (weight * at.jacobian) - w * sine * turn;
            s.gradient += sine * (weight * at.jacobian) + w * cosine * turn;
        }
        return {c, s};
    }

    Number pits(std::size_t k, const Domain& at, double worn) const {
        const Octave& octave = part().octaves[k];
        const auto p = split_position<2>(octave_position<2>(octave, {at.at.x, at.at.z}));
        const HWY_NAMESPACE::HermiteCurve profile{kPitProfile};
        Number sum;
        for (unsigned corner = 0; corner < 4; ++corner) {
            const bool right = (corner & 1) != 0, up = (corner & 2) != 0;
            const Pit pit = pit_of(word_of(octave, p.cell, right, up), worn);
            const double tx = p.fraction[0] - right - pit.x, tz = p.fraction[1] - up - pit.z;
            const double q = (tx * tx + tz * tz) / (pit.radius * pit.radius), scale = pit.depth * pit.radius;
            const glm::dvec3 there = 2.0 * octave.frequency / (pit.radius * pit.radius) * glm::dvec3(tx, 0.0, tz);
            sum.value += scale * profile.value(q);
            sum.gradient += scale * profile.slope(q) * (there * at.jacobian);
        }
        return sum;
    }

    Number input(std::size_t i, const Domain& at) const { return of(parts_, part().inputs[i], dimensions_of(), at); }

    static Number of(std::span<const ReliefPart> parts, std::size_t index, int dimensions, const Domain& at) {
        JetNumbers numbers(parts, index, dimensions);
        return std::visit([&](const auto& node) { return HWY_NAMESPACE::relief_of(node, numbers, at); },
                          parts[index].node);
    }

  private:
    static std::uint32_t word_of(const Octave& octave, const std::array<std::int64_t, 2>& cell, bool right, bool up) {
        return plane_pair(cell[0], octave.key.axis[0])[right ? 1 : 0] ^
               plane_pair(cell[1], octave.key.axis[1])[up ? 1 : 0];
    }
    static double phase_of(const Octave& octave, const std::array<std::int64_t, 2>& cell, bool right, bool up) {
        return static_cast<double>(corner_hash(word_of(octave, cell, right, up)) >> kPhaseShift) * kPhaseUnit;
    }

    int dimensions_of() const { return static_cast<int>(dimensions()); }

    std::span<const ReliefPart> parts_;
};

}  // namespace

ReliefJet Relief::jet(const glm::dvec3& x) const {
    return JetNumbers::of(parts_, parts_.size() - 1, dimensions_, {.at = x});
}

}  // namespace strata::noise
