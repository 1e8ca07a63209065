#include <algorithm>
#include <limits>

#include "src/image/compare.h"

#include "tools/converge/experiment.h"

namespace strata::tools::converge {

using scene::EstimatorKind;

int order_of(EstimatorKind kind, int m) { return scene::row_of(kind).is_box() ? 1 : m; }

void Point::add(const film::Film& film, const Reference& reference) {
    image::Picture made = image::make_picture(film.window().width(), film.window().height());
    std::vector<double> error;
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        const glm::vec3& pixel = film.pixels()[i];
        for (int c = 0; c < 3; ++c) made.rgb[3 * i + static_cast<std::size_t>(c)] = pixel[c];
        const glm::dvec3 wide(pixel);
        error.push_back((wide.x + wide.y + wide.z) / 3 - reference.grey[i]);
    }
    const image::Comparison comparison = image::compare(made, reference.picture);
    mean_squares.push_back(comparison.rmse * comparison.rmse);
    relative.push_back(comparison.relative_rmse);
    largest.push_back(comparison.max_abs);
    percentile99.push_back(comparison.percentile99);
    errors.add(error);
}

Limit limit_of(const Point& point, const Reference& reference) {
    constexpr double kLimited = 3;
    constexpr double kRounding = 4 * 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
    const double rmse = point.rmse().value;
    if (rmse <= kRounding * reference.root_mean_square) return Limit::rounding;
    return rmse <= kLimited * reference.error ? Limit::reference : point.limit;
}

RootMean Point::rmse() const { return root_mean(mean_squares, fixed); }

const Reference& Experiment::reference_of(const Point& point) const {
    const int order = order_of(point.estimator, point.m);
    return *std::ranges::find_if(references, [order](const Reference& r) { return r.m == order; });
}

bool unbiased(EstimatorKind kind) { return scene::row_of(kind).is_unbiased(); }

bool deterministic(EstimatorKind kind, const scene::Scene& scene) {
    const scene::EstimatorRow& row = scene::row_of(kind);
    if (row.is_single) return true;
    const bool instant = !(scene.shutter.open_s > 0);
    return instant && row.is_grid();
}

}  // namespace strata::tools::converge
