#include "tools/converge/power_law.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "src/render/confidence.h"

namespace strata::tools::converge {

double PowerLaw::at(double x) const { return std::pow(10.0, log10_factor + slope * std::log10(x)); }

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y,
                                      std::span<const double> relative_ci) {
    const std::size_t n = x.size();
    if (n < 3) return std::nullopt;
    double mean_x = 0;
    double mean_y = 0;
    for (std::size_t i = 0; i < n; ++i) {
        mean_x += std::log10(x[i]) / static_cast<double>(n);
        mean_y += std::log10(y[i]) / static_cast<double>(n);
    }
    double xx = 0;
    double xy = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double dx = std::log10(x[i]) - mean_x;
        xx += dx * dx;
        xy += dx * (std::log10(y[i]) - mean_y);
    }
    if (!(xx > 0)) return std::nullopt;
    PowerLaw law{xy / xx, 0, 0, static_cast<int>(n)};
    law.log10_factor = mean_y - law.slope * mean_x;

    // The slope is a weighted sum of the log y, with weights dx / xx.
    double scatter = 0;
    double measured = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double dx = std::log10(x[i]) - mean_x;
        const double residual = std::log10(y[i]) - law.log10_factor - law.slope * std::log10(x[i]);
        scatter += residual * residual;
        const double ci = std::isfinite(relative_ci[i]) ? relative_ci[i] / std::log(10.0) : 0;
        measured += (dx / xx) * (dx / xx) * ci * ci;
    }
    const int dof = static_cast<int>(n) - 2;
    const double by_scatter = render::student_quantile(0.975, dof) * std::sqrt(scatter / dof / xx);
    law.slope_ci = std::max(by_scatter, std::sqrt(measured));
    return law;
}

std::optional<TimeToError> time_to_error(double error, std::span<const double> seconds, std::span<const double> errors,
                                         const std::optional<PowerLaw>& law) {
    if (errors.empty()) return std::nullopt;
    if (errors[0] <= error) return TimeToError{seconds[0], Reach::at_first};
    for (std::size_t i = 1; i < errors.size(); ++i) {
        if (errors[i] > error) continue;
        const double share = std::log(errors[i - 1] / error) / std::log(errors[i - 1] / std::max(errors[i], 1e-300));
        return TimeToError{seconds[i - 1] * std::pow(seconds[i] / seconds[i - 1], share), Reach::interpolated};
    }
    if (!law || !(law->slope < 0)) return std::nullopt;
    // Along the law's slope from the last point, so that the curve has no step.
    const double ratio = std::pow(error / errors.back(), 1 / law->slope);
    return TimeToError{seconds.back() * ratio, Reach::extrapolated};
}

}  // namespace strata::tools::converge
