#include "src/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "src/image/image_error.h"

namespace strata::image {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The value of rank ceil(99 % of n), counted from 1.
double percentile99(std::vector<double>& values) {
    if (values.empty()) return kNaN;
    const std::size_t rank = (values.size() * 99 + 99) / 100;
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

double root_mean(double sum, std::size_t count) {
    return count == 0 ? kNaN : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

void require_equal_sizes(const Picture& picture, const Picture& reference, const char* what, const char* other) {
    if (picture.width() == reference.width() && picture.height() == reference.height()) return;
    throw ImageError(fmt::format("pictures of different size cannot be compared: {} has {}x{} pixels, {} {}x{}", what,
                                 picture.width(), picture.height(), other, reference.width(), reference.height()));
}

Comparison compare(const Picture& picture, const Picture& reference) {
    require_equal_sizes(picture, reference);
    Comparison result;
    std::array<double, 3> squares{};
    std::array<std::size_t, 3> counts{};
    double reference_squares = 0;
    std::vector<double> distances;
    distances.reserve(picture.rgb.size());
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const double value = picture.rgb[i], expected = reference.rgb[i];
        if (!std::isfinite(value) || !std::isfinite(expected)) {
            ++result.not_finite;
            continue;
        }
        const double d = value - expected;
        squares[i % 3] += d * d;
        ++counts[i % 3];
        reference_squares += expected * expected;
        distances.push_back(std::fabs(d));
    }

    const std::size_t count = distances.size();
    for (std::size_t c = 0; c < 3; ++c) result.channel_rmse[c] = root_mean(squares[c], counts[c]);
    result.rmse = root_mean(squares[0] + squares[1] + squares[2], count);
    result.relative_rmse = result.rmse == 0 ? 0 : result.rmse / root_mean(reference_squares, count);
    result.max_abs = count == 0 ? kNaN : *std::ranges::max_element(distances);
    result.percentile99 = percentile99(distances);
    return result;
}

}  // namespace strata::image
