#include "tools/converge/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/render/confidence.h"

namespace strata::tools::converge {

RootMean root_mean(std::span<const double> squares, bool exact) {
    const auto n = static_cast<double>(squares.size());
    const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / n;
    const double root = std::sqrt(mean);
    if (exact || root == 0) return {root, 0};
    if (squares.size() < 2) return {root, std::numeric_limits<double>::infinity()};
    double deviations = 0;
    for (const double square : squares) deviations += (square - mean) * (square - mean);
    const double standard_error = std::sqrt(deviations / (n - 1) / n);
    // d sqrt(x) = dx / (2 sqrt(x)).
    return {root, render::student_quantile(0.975, static_cast<int>(squares.size()) - 1) * standard_error / (2 * root)};
}

PixelErrors::PixelErrors(int width, int height)
    : width_(width),
      height_(height),
      sum_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0),
      squares_(sum_.size(), 0.0) {}

void PixelErrors::add(std::span<const double> error) {
    assert(error.size() == sum_.size());
    ++seeds_;
    const auto pair = [this](double a, double b) {
        products_ += a * b;
        left_squares_ += a * a;
        right_squares_ += b * b;
    };
    const auto width = static_cast<std::size_t>(width_);
    for (std::size_t i = 0; i < error.size(); ++i) {
        sum_[i] += error[i];
        squares_[i] += error[i] * error[i];
        if ((i + 1) % width != 0) pair(error[i], error[i + 1]);
        if (i + width < error.size()) pair(error[i], error[i + width]);
    }
}

double PixelErrors::mean() const {
    return std::accumulate(sum_.begin(), sum_.end(), 0.0) / static_cast<double>(sum_.size()) / seeds_;
}

double PixelErrors::z_of_mean(double truth_error) const {
    assert(seeds_ >= 2);
    const double n = seeds_;
    double variance = 0;  // of the sum over pixels of the mean over seeds
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        variance += std::max(0.0, squares_[i] - sum_[i] * sum_[i] / n) / (n - 1) / n;
    }
    const auto pixels = static_cast<double>(sum_.size());
    const double standard_error = std::hypot(std::sqrt(variance) / pixels, truth_error);
    return standard_error > 0 ? mean() / standard_error : mean() == 0 ? 0 : std::copysign(INFINITY, mean());
}

PixelErrors::SquaredBias PixelErrors::squared_bias() const {
    assert(seeds_ >= 2);
    const double n = seeds_;
    double total = 0;
    double total_squares = 0;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        const double product = (sum_[i] * sum_[i] - squares_[i]) / (n * (n - 1));
        total += product;
        total_squares += product * product;
    }
    const auto pixels = static_cast<double>(sum_.size());
    return {total / pixels, std::sqrt(total_squares) / pixels};
}

double PixelErrors::z_of_squares(double truth_error) const {
    const SquaredBias bias = squared_bias();
    const double standard_error = std::hypot(bias.standard_error, truth_error * truth_error);
    return standard_error > 0 ? bias.mean / standard_error : 0;
}

double PixelErrors::neighbour_correlation() const {
    const double scale = std::sqrt(left_squares_ * right_squares_);
    return scale > 0 ? products_ / scale : 0;
}

double sidak_threshold(double family_level, std::size_t tests, bool two_sided) {
    const double each = -std::expm1(std::log1p(-family_level) / static_cast<double>(std::max<std::size_t>(1, tests)));
    return -render::normal_quantile(two_sided ? each / 2 : each);
}

}  // namespace strata::tools::converge
