// A curve through knots by cubic pieces, each given by the values and slopes at its two ends (Hermite's form):
// continuously differentiable, with a second derivative that is linear on every piece. Before the first knot and after
// the last one it is straight.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace strata::noise {

struct HermiteKnot {
    double x, y, slope;
};

// Piece i is y + c1 t + c2 t^2 + c3 t^3 of t = (v - x) per_width; it begins at x. Piece 0, the straight one, ends at
// the x that it has in common with piece 1. Each x is a float, so that v - x is the same in float but for one rounding.
struct HermiteTable {
    static constexpr std::size_t kMostKnots = 16;

    std::size_t pieces = 0;
    std::array<double, kMostKnots + 1> x{}, per_width{}, y{}, c1{}, c2{}, c3{};

    // The largest numbers that values and slopes are added up from: what their roundings are in proportion to.
    double value_unit = 1.0, slope_unit = 1.0;
};

// From 2 to 16 knots, x increasing. Between knots the curve must not turn round: where it rises and falls its highest
// and lowest points are knots.
constexpr HermiteTable make_hermite(std::span<const HermiteKnot> knots) {
    const auto rounded = [](double v) { return static_cast<double>(static_cast<float>(v)); };
    const auto size = [](double v) { return v < 0.0 ? -v : v; };
    HermiteTable table;
    const auto add = [&](double x, double per_width, double y, double c1, double c2, double c3) {
        const std::size_t i = table.pieces++;
        table.x[i] = rounded(x);
        table.per_width[i] = per_width;
        table.y[i] = y;
        table.c1[i] = c1;
        table.c2[i] = c2;
        table.c3[i] = c3;
        const double value = size(y) + size(c1) + size(c2) + size(c3);
        const double slope = (size(c1) + 2.0 * size(c2) + 3.0 * size(c3)) * per_width;
        if (value > table.value_unit) table.value_unit = value;
        if (slope > table.slope_unit) table.slope_unit = slope;
    };
    const HermiteKnot &first = knots.front(), &last = knots.back();
    add(first.x, 1.0, first.y, first.slope, 0.0, 0.0);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const HermiteKnot &a = knots[i], &b = knots[i + 1];
        const double width = rounded(b.x) - rounded(a.x), rise = b.y - a.y;
        const double out = width * a.slope, in = width * b.slope;
        add(a.x, 1.0 / width, a.y, out, 3.0 * rise - 2.0 * out - in, out + in - 2.0 * rise);
    }
    add(last.x, 1.0, last.y, last.slope, 0.0, 0.0);
    return table;
}

// The slopes at knots of a curve that rises where its points rise and falls where they fall, and is level at their
// turning points: harmonic means of the neighbouring chords' slopes, weighted by the chords (F. N. Fritsch and
// J. Butland, "A method for constructing local monotone piecewise cubic interpolants", 1984); at the ends the chord's.
constexpr void set_monotone_slopes(std::span<HermiteKnot> knots) {
    const auto chord = [&](std::size_t i) { return (knots[i + 1].y - knots[i].y) / (knots[i + 1].x - knots[i].x); };
    const std::size_t last = knots.size() - 1;
    knots[0].slope = chord(0);
    knots[last].slope = chord(last - 1);
    for (std::size_t i = 1; i < last; ++i) {
        const double before = chord(i - 1), after = chord(i);
        const double left = knots[i].x - knots[i - 1].x, right = knots[i + 1].x - knots[i].x;
        knots[i].slope = before * after > 0.0
                             ? 3.0 * (left + right) / ((2.0 * right + left) / before + (right + 2.0 * left) / after)
                             : 0.0;
    }
}

}  // namespace strata::noise
