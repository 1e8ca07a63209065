// Bounds of reliefs over their whole domain: their formulas, read with numbers that are bounds.
#include "noise/relief/certificate.h"

#define STRATA_RELIEF_FORMULAS
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "noise/relief/frame.h"
#include "noise/relief/nodes/all.h"
#include "noise/relief/pits.h"
#include "noise/relief/stripe.h"

namespace strata::noise {

namespace {

class BoundNumbers : public ReliefFrame {
  public:
    using Number = Certificate;
    using Displacement = std::array<Number, 3>;
    // Of the map from the point where the relief is asked for: the Lipschitz constants of itself and of its Jacobian.
    struct Domain {
        double slope = 1.0;
        double bend = 0.0;
    };

    BoundNumbers(std::span<const ReliefPart> parts, std::size_t index, int dimensions)
        : ReliefFrame(parts[index], dimensions), parts_(parts) {}

    static Number constant(double x) { return {x, x, 0.0, 0.0}; }
    static Number plus(const Number& a, const Number& b) {
        return {a.low + b.low, a.high + b.high, a.slope + b.slope, a.bend + b.bend};
    }
    static Number scaled(const Number& a, double by) {
        return {std::min(by * a.low, by * a.high), std::max(by * a.low, by * a.high), std::abs(by) * a.slope,
                std::abs(by) * a.bend};
    }
    // (a b)'' = a b'' + 2 a' b' + a'' b.
    static Number product(const Number& a, const Number& b) {
        const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
        return {low, high, a.size() * b.slope + b.size() * a.slope,
                a.size() * b.bend + 2.0 * a.slope * b.slope + b.size() * a.bend};
    }
    static Number product_of_positive(const Number& a, const Number& b) { return product(a, b); }
    // g(r)'' = g' r'' + g'' r'^2.
    template <class Curve>
    static Number curved(const Curve& curve, const Number& a) {
        const auto [low, high] = curve.range(a.low, a.high);
        const double steepest = curve.steepest(a.low, a.high);
        const double bend = std::max(curve.bend_up(a.low, a.high), curve.bend_down(a.low, a.high));
        return {low, high, steepest * a.slope, steepest * a.bend + bend * a.slope * a.slope};
    }

    Number octave(std::size_t k, const Domain& at) const {
        const double frequency = part().octaves[k].frequency, across = frequency * at.slope;
        return {-peak(), peak(), bounds().gradient * across,
                bounds().second * across * across + bounds().gradient * frequency * at.bend};
    }
    Number octave(std::size_t k, const Domain& at, double by) const { return scaled(octave(k, at), by); }

    static Number begin_sum() { return {}; }
    static bool sees(Number&, std::size_t, const Domain&, double, double) { return true; }
    static bool sees_stripe(Number&, std::size_t, const Domain&, double, double) { return true; }
    static bool sees_cells(Number&, double, const Domain&, double, double) { return true; }
    static bool sees_weighed(Number&, std::size_t, const Domain&, const Number&, double, double) { return true; }
    static void add(Number& sum, const Number& term) { sum = plus(sum, term); }
    static Number total(const Number& sum) { return sum; }

    static Displacement no_displacement() { return {}; }
    // The components' slopes are those of one row of the Jacobian each: their squares add up.
    Domain displaced(const Domain& at, const Displacement& u) const {
        double slope = 0.0, bend = 0.0;
        for (std::size_t i = 0; i < dimensions(); ++i) {
            slope += u[i].slope * u[i].slope;
            bend += u[i].bend * u[i].bend;
        }
        return {at.slope + std::sqrt(slope), at.bend + std::sqrt(bend)};
    }

    static Domain shifted(const Domain& at, int, double) { return at; }

    using Pair = std::pair<Number, Number>;

    static Pair unit(const Number& x, const Number& y, double c) {
        const double slope = std::hypot(x.slope, y.slope), bend = std::hypot(x.bend, y.bend);
        const Number either{-1.0, 1.0, slope / c, bend / c + kUnitBend / (c * c) * slope * slope};
        return {either, either};
    }
    static Number norm(const Number& x, const Number& y, double c) {
        const double slope = std::hypot(x.slope, y.slope);
        return {0.0, std::hypot(x.size(), y.size()), slope, std::hypot(x.bend, y.bend) + slope * slope / c};
    }
    // A share in [0, 1].
    static Number part_of(const Number& whole, const Number& share) {
        Number part = product(whole, share);
        part.low = std::max(part.low, std::min(whole.low, 0.0));
        part.high = std::min(part.high, whole.high);
        return part;
    }

    // (1 - s) a + s b for a share s in [0, 1]: (1 - s) a' + s b' + (b - a) s', and so on.
    static Number mixed(const Number& a, const Number& b, const Number& share) {
        const double apart = std::max(b.high - a.low, a.high - b.low);
        return {std::min(a.low, b.low), std::max(a.high, b.high), std::max(a.slope, b.slope) + apart * share.slope,
                std::max(a.bend, b.bend) + 2.0 * (a.slope + b.slope) * share.slope + apart * share.bend};
    }
    // m = (a + b + R) / 2, R^2 = d^2 + softness^2 with d = a - b: m' is between a' and b', and m'' as well but for
    // softness^2 d'^2 / (2 R^3) <= d'^2 / (2 softness). m rises with a and with b.
    static Number highest(const Number& a, const Number& b, double softness) {
        const auto of = [&](double x, double y) { return 0.5 * (x + y + std::hypot(x - y, softness)); };
        const double apart = a.slope + b.slope;
        return {of(a.low, b.low), of(a.high, b.high), std::max(a.slope, b.slope),
                std::max(a.bend, b.bend) + apart * apart / (2.0 * softness)};
    }
    static Number along(const Domain& at, double per_x, double per_z, double, bool) {
        constexpr double kEndless = std::numeric_limits<double>::infinity();
        const double per = std::hypot(per_x, per_z);
        return {-kEndless, kEndless, per * at.slope, per * at.bend};
    }

    Number pits(std::size_t k, const Domain& at, double) const {
        constexpr PitBounds of;
        const double frequency = part().octaves[k].frequency, across = frequency * at.slope;
        return {2.0 * kWidest * of.low, 4.0 * kWidest * of.high, 4.0 * of.slope * across,
                4.0 * of.bend_down / kNarrowest * across * across + 4.0 * of.slope * frequency * at.bend};
    }

    // By u = x^2 + z^2 of the scaled coordinates 1 / (1 + u)^2 falls by 4 sqrt(u) / (1 + u)^3 <= 1.08 along the radius,
    // and the second derivative is at most 4, at the middle.
    static Number fall_off(const Domain& at, double, double, double per_x, double per_z) {
        const double per = std::max(per_x, per_z), across = per * at.slope;
        return {0.0, 1.0, 1.08 * across, 4.0 * across * across + 1.08 * per * at.bend};
    }

    Pair stripe(std::size_t k, const Domain& at, const Number& dx, const Number& dz, double bands) const {
        const StripeBounds of(bands);
        const double frequency = part().octaves[k].frequency, across = frequency * at.slope;
        const double turn = std::hypot(dx.slope, dz.slope), bend = std::hypot(dx.bend, dz.bend);
        const Number either{-1.0, 1.0, of.by_place * across + of.by_direction * turn,
                            of.place_twice * across * across + 2.0 * of.place_direction * across * turn +
                                of.direction_twice * turn * turn + of.by_place * frequency * at.bend +
                                of.by_direction * bend};
        return {either, either};
    }

    Number input(std::size_t i, const Domain& at) const {
        return of(parts_, part().inputs[i], static_cast<int>(dimensions()), at);
    }

    static Number of(std::span<const ReliefPart> parts, std::size_t index, int dimensions, const Domain& at) {
        BoundNumbers numbers(parts, index, dimensions);
        return std::visit([&](const auto& node) { return HWY_NAMESPACE::relief_of(node, numbers, at); },
                          parts[index].node);
    }

  private:
    std::span<const ReliefPart> parts_;
};

}  // namespace

Certificate certificate_of(std::span<const ReliefPart> parts, std::size_t last, int dimensions) {
    return BoundNumbers::of(parts, last, dimensions, {});
}

}  // namespace strata::noise
