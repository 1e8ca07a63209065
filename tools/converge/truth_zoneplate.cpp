// The zone plate under a separable filter. With phase a (x^2 + y^2), cos of it is the real part of
// exp(i a x^2) exp(i a y^2), so a pixel is 1/2 + 1/2 Re(F(column) F(row)), where F is one integral over one coordinate.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "src/filter/bspline.h"
#include "tools/converge/quadrature.h"
#include "tools/converge/truth.h"

namespace strata::tools::converge {

namespace {

using Complex = std::complex<double>;

constexpr double kFastest = 1e4;  // radians a pixel

// On a piece of the spline, a polynomial, cut so that the phase turns by at most a radian in each part.
Complex filtered_wave(int m, double a, double centre, const GaussLegendre& rule, int cuts) {
    Complex sum = 0;
    for (int piece = 0; piece < m; ++piece) {
        const double low = piece - 0.5 * m;
        const double fastest = 2 * std::fabs(a) * std::max(std::fabs(centre + low), std::fabs(centre + low + 1));
        const int parts = cuts * std::max(1, static_cast<int>(std::ceil(fastest)));
        for (int part = 0; part < parts; ++part) {
            const double from = low + static_cast<double>(part) / parts;
            const double to = low + static_cast<double>(part + 1) / parts;
            sum += rule.integrate(from, to, [&](double x) {
                const double position = centre + x;
                return filter::bspline_pdf(m, x + 0.5 * m) * std::polar(1.0, a * position * position);
            });
        }
    }
    return sum;
}

struct Axis {
    std::vector<Complex> F;
    double error = 0;
};

Axis filtered_axis(int m, double a, int first, int last, double origin) {
    const GaussLegendre rule(12 + m / 2);
    Axis axis;
    for (int i = first; i < last; ++i) {
        const double centre = i + 0.5 - origin;
        const Complex coarse = filtered_wave(m, a, centre, rule, 1);
        axis.F.push_back(filtered_wave(m, a, centre, rule, 2));
        axis.error = std::max(axis.error, std::abs(axis.F.back() - coarse));
    }
    return axis;
}

}  // namespace

std::optional<Truth> exact_zoneplate(const scene::Zoneplate& zoneplate, const scene::Film& film, int m,
                                     const film::Rect& window) {
    const double edge = 0.5 * std::min(film.width, film.height);
    const double rings = zoneplate.rings > 0 ? zoneplate.rings : edge / 4;
    const double a = 2 * std::numbers::pi * rings / (edge * edge);
    const double farthest = std::max(film.width, film.height) + m;
    if (2 * a * farthest > kFastest) return std::nullopt;
    const Axis columns = filtered_axis(m, a, window.x0, window.x1, 0.5 * film.width);
    const Axis rows = filtered_axis(m, a, window.y0, window.y1, 0.5 * film.height);
    Truth truth;
    for (const Complex& row : rows.F) {
        for (const Complex& column : columns.F) truth.grey.push_back(0.5 + 0.5 * (row * column).real());
    }
    // |F| <= 1. The coarser rule bounds the finer one's error.
    truth.error = 0.5 * (columns.error + rows.error) + 1e-13;
    truth.how = "product of two one-dimensional integrals, by Gauss-Legendre quadrature checked by halving";
    return truth;
}

}  // namespace strata::tools::converge
