// Errors that fall as a power of what is spent: y = c x^slope, a line on logarithmic axes.
#pragma once

#include <optional>
#include <span>

namespace strata::tools::converge {

struct PowerLaw {
    double slope = 0;
    double slope_ci = 0;      // half the width of its 95 % confidence interval
    double log10_factor = 0;  // log10 c
    int points = 0;

    double at(double x) const;
};

// Least squares in log10 x, log10 y. relative_ci: half the widths of the 95 % intervals of the y, over y. The slope's
// interval holds both these and the points' scatter about the line (Student's t). Nothing for fewer than three points
// or x all alike. x and y positive.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y,
                                      std::span<const double> relative_ci);

// How a time was found.
enum class Reach { interpolated, extrapolated, at_first };  // at_first: the cheapest point is below the error already

struct TimeToError {
    double seconds = 0;
    Reach reach = Reach::interpolated;
};

// The time in which the error falls to `error`, by straight lines between neighbouring points on logarithmic axes in
// the order given (of growing N), where it first does; beyond the last point by `law`, of error against time. Nothing
// where there is no law, or one that does not fall.
std::optional<TimeToError> time_to_error(double error, std::span<const double> seconds, std::span<const double> errors,
                                         const std::optional<PowerLaw>& law);

}  // namespace strata::tools::converge
