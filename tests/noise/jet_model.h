// The rounding error of noise2 and noise3 (noise/noise-inl.h) over a box of fractions, whatever the corners' gradients.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "noise/gradients.h"
#include "tests/noise/rounding_model.h"

namespace strata::noise::test {

// One of each pair g, -g: errors are even.
template <std::size_t D>
std::vector<std::array<double, D>> half_the_gradients() {
    std::vector<std::array<double, D>> half;
    const auto add = [&](const auto& g) {
        std::array<double, D> copy, opposite;
        for (std::size_t a = 0; a < D; ++a) copy[a] = static_cast<double>(g[a]), opposite[a] = -copy[a];
        const auto is_there = [&](const auto& x) { return std::find(half.begin(), half.end(), x) != half.end(); };
        if (!is_there(copy) && !is_there(opposite)) half.push_back(copy);
    };
    if constexpr (D == 2) {
        for (const auto& g : kGradients2) add(g);
    } else {
        for (const auto& g : kGradients3) add(g);
    }
    return half;
}

// One corner with one gradient. Forms are named by the set of axes, as bits, along which they are differences.
template <std::size_t D>
class CornerModel {
  public:
    CornerModel(const std::array<AxisModel, D>& axes, std::size_t corner, const std::array<double, D>& gradient)
        : axes_(axes), corner_(corner), gradient_(gradient), dot_(dot()) {}

    double value() const {
        return n(0).error + weight_errors([&](std::size_t k) { return n(1u << k).exact; });
    }

    double axis(std::size_t i) const {
        const Part sum = multiply_add(axes_[i].first, n(1u << i), g(i, 0));
        return sum.error + weight_errors([&](std::size_t k) { return axis_by_weight(i, k); });
    }

    double slope() const {
        double squares = 0.0;
        for (std::size_t i = 0; i < D; ++i) {
            const Part sum = multiply_add(axes_[i].first, n(1u << i), g(i, 0));
            squares += sum.error * sum.error;
        }
        double error = std::sqrt(squares);
        for (std::size_t k = 0; k < D; ++k) {
            squares = 0.0;
            for (std::size_t i = 0; i < D; ++i) squares += std::pow(axis_by_weight(i, k).size(), 2);
            error += axes_[k].fade.error * std::sqrt(squares);
        }
        return error;
    }

    double diagonal(std::size_t i) const {
        const std::size_t I = 1u << i;
        const Part sum = multiply_add(axes_[i].second, n(I), twice(product(axes_[i].first, g(i, I))));
        return sum.error + weight_errors([&](std::size_t k) {
                   if (k == i) return Range{};
                   const std::size_t K = 1u << k;
                   return axes_[i].second.exact * n(I | K).exact + 2.0 * (axes_[i].first.exact * g(i, I | K).exact);
               });
    }

    // i < j.
    double mixed(std::size_t i, std::size_t j) const {
        const std::size_t I = 1u << i, J = 1u << j;
        const Part inner = multiply_add(axes_[j].first, n(I | J), g(j, I));
        const Part sum = multiply_add(axes_[i].first, inner, product(axes_[j].first, g(i, J)));
        const Range &di = axes_[i].first.exact, &dj = axes_[j].first.exact;
        return sum.error + weight_errors([&](std::size_t k) {
                   const std::size_t K = 1u << k;
                   Range r;
                   if (k != i && k != j) r = r + di * dj * n(I | J | K).exact;
                   if (k != i) r = r + di * g(j, I | K).exact;
                   if (k != j) r = r + dj * g(i, J | K).exact;
                   return r;
               });
    }

  private:
    // The dot product: sums with a zero term are exact, as are products with 0 and +-1.
    Part dot() const {
        Part dot;
        for (std::size_t a = 0; a < D; ++a) {
            if (gradient_[a] == 0.0) continue;
            const Part& offset = is_above(a) ? axes_[a].above : axes_[a].below;
            Part term{gradient_[a] * offset.exact, std::abs(gradient_[a]) * offset.error};
            if (std::abs(gradient_[a]) != 1.0) term.error += rounding(term.size());
            const bool is_first = dot.exact.size() == 0.0 && dot.error == 0.0;
            dot = {dot.exact + term.exact, dot.error + term.error};
            if (!is_first) dot.error += rounding(dot.size());
        }
        return dot;
    }

    bool is_above(std::size_t a) const { return (corner_ >> a & 1u) != 0; }

    // Differences of whole numbers stay whole: first of 0 and +-1, whose differences 0, +-1, +-2 times t are exact too.
    Part form(Part x, std::size_t differences, Exact exact) const {
        for (std::size_t a = 0; a < D; ++a) {
            const bool is_difference = (differences >> a & 1u) != 0;
            x = is_difference ? difference(x, is_above(a), exact) : lerp(x, is_above(a), axes_[a].weight(), exact);
            const bool stays_whole = exact != Exact::nothing && is_difference;
            exact = stays_whole ? Exact::difference : Exact::nothing;
        }
        return x;
    }

    Part n(std::size_t differences) const { return form(dot_, differences, Exact::nothing); }
    Part g(std::size_t i, std::size_t differences) const {
        return form({{gradient_[i], gradient_[i]}, 0.0}, differences, D == 3 ? Exact::product : Exact::nothing);
    }

    // d/du_k of the gradient's component i.
    Range axis_by_weight(std::size_t i, std::size_t k) const {
        const Range own = g(i, 1u << k).exact;
        return k == i ? own : axes_[i].first.exact * n(1u << i | 1u << k).exact + own;
    }

    // The fades' errors times the derivatives by them: every form is linear in each.
    template <class Derivative>
    double weight_errors(const Derivative& derivative) const {
        double error = 0.0;
        for (std::size_t k = 0; k < D; ++k) error += axes_[k].fade.error * derivative(k).size();
        return error;
    }

    const std::array<AxisModel, D>& axes_;
    std::size_t corner_;
    std::array<double, D> gradient_;
    Part dot_;
};

// Bound of the error of what `output` takes from a corner's model, in units of e, for every float fraction of the box.
template <std::size_t D, class Output>
double jet_error(const std::array<Range, D>& box, const Output& output) {
    static const std::vector<std::array<double, D>> gradients = half_the_gradients<D>();
    std::array<AxisModel, D> axes;
    for (std::size_t a = 0; a < D; ++a) axes[a] = axis_model(box[a].lo, box[a].hi);
    double error = 0.0;
    for (std::size_t corner = 0; corner < std::size_t{1} << D; ++corner) {
        double largest = 0.0;
        for (const auto& g : gradients) largest = std::max(largest, output(CornerModel<D>(axes, corner, g)));
        error += largest;
    }
    return error;
}

}  // namespace strata::noise::test
