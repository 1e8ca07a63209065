#include "tools/converge/truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/filter/bspline.h"
#include "tools/converge/quadrature.h"

namespace strata::tools::converge {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRounding = 1e-13;  // of sums of a few hundred positive terms

template <class Grey>
std::vector<double> pixels(const film::Rect& window, const Grey& grey) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height()));
    for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x) values.push_back(grey(x + 0.5, y + 0.5));
    }
    return values;
}

Truth exact_edge(const scene::Edge& edge, const scene::Film& film, int m, const film::Rect& window) {
    const double cosine = std::cos(edge.angle_deg * kDegree);
    const double sine = std::sin(edge.angle_deg * kDegree);
    const auto grey = [&](double u, double v) {
        const double inside = (u - 0.5 * film.width) * cosine + (0.5 * film.height - v) * sine - edge.offset;
        return edge_coverage(m, edge.angle_deg, inside);
    };
    return {pixels(window, grey), kRounding, "distribution function of the projected filter, exact on its pieces"};
}

// Symmetric filters leave linear functions as they are.
Truth exact_ramp(const scene::Ramp& ramp, const scene::Film& film, const film::Rect& window) {
    const double right = ramp.rise / film.width * std::cos(ramp.angle_deg * kDegree);
    const double up = ramp.rise / film.width * std::sin(ramp.angle_deg * kDegree);
    const auto grey = [&](double u, double v) {
        return 0.5 + right * (u - 0.5 * film.width) + up * (0.5 * film.height - v);
    };
    return {pixels(window, grey), kRounding * std::max(1.0, std::fabs(ramp.rise)),
            "closed form: the filter leaves a ramp as it is"};
}

Truth exact_constant(const scene::Constant& constant, const film::Rect& window) {
    const double value = static_cast<double>(static_cast<float>(constant.value));
    return {pixels(window, [value](double, double) { return value; }), 0, "closed form: the constant, as a float"};
}

}  // namespace

double edge_coverage(int m, double angle_deg, double d) {
    const double a = std::fabs(std::cos(angle_deg * kDegree));
    const double b = std::fabs(std::sin(angle_deg * kDegree));
    const double wide = std::max(a, b);
    const double narrow = std::min(a, b);
    const double half = 0.5 * m;
    if (d >= half * (wide + narrow)) return 1;
    if (d <= -half * (wide + narrow)) return 0;
    // P = integral of n_m(y) N_m((d - narrow y) / wide + m/2) over y: a polynomial between the knots of both.
    std::vector<double> knots;
    for (int k = 0; k <= m; ++k) {
        knots.push_back(k - half);
        if (narrow > 0) knots.push_back(std::clamp((d - wide * (k - half)) / narrow, -half, half));
    }
    std::sort(knots.begin(), knots.end());
    const GaussLegendre rule(m);
    double sum = 0;
    for (std::size_t i = 1; i < knots.size(); ++i) {
        if (!(knots[i] > knots[i - 1])) continue;
        sum += rule.integrate(knots[i - 1], knots[i], [&](double y) {
            return filter::bspline_pdf(m, y + half) * filter::bspline_cdf(m, (d - narrow * y) / wide + half);
        });
    }
    return std::clamp(sum, 0.0, 1.0);
}

bool has_exact_picture(const scene::Scene& scene) {
    return scene.image != scene::ImageKind::surface && scene.image != scene::ImageKind::wheel;
}

std::optional<Truth> exact_picture(const scene::Scene& scene, int m, const film::Rect& window) {
    switch (scene.image) {
        case scene::ImageKind::edge:
            return exact_edge(scene.edge, scene.film, m, window);
        case scene::ImageKind::ramp:
            return exact_ramp(scene.ramp, scene.film, window);
        case scene::ImageKind::constant:
            return exact_constant(scene.constant, window);
        case scene::ImageKind::zoneplate:
            return exact_zoneplate(scene.zoneplate, scene.film, m, window);
        case scene::ImageKind::checker:
            return exact_checker(scene.checker, scene.film, m, window);
        case scene::ImageKind::surface:
        case scene::ImageKind::wheel:
            break;
    }
    return std::nullopt;
}

}  // namespace strata::tools::converge
