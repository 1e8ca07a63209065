#include "src/estimate/render_accumulators.h"

#include <algorithm>

namespace strata::estimate {

namespace {

constexpr std::size_t kPageDoubles = 512;
constexpr std::size_t kRowOffset = 40;

// Rows a multiple of 4096 bytes apart would compete for the same cache sets and store-buffer addresses.
std::size_t padded_stride(int width) {
    const std::size_t used = static_cast<std::size_t>(width) * kChannels;
    return (used + kPageDoubles - 1) / kPageDoubles * kPageDoubles + kRowOffset;
}

}  // namespace

PixelAccumulators::PixelAccumulators(const film::Rect& window, const BsplineWeights& weights, int rows)
    : weights_(weights),
      sums_(static_cast<std::size_t>(rows) * padded_stride(window.width()), 0.0),
      rows_{window, rows, padded_stride(window.width()), sums_.data()} {}

// set(x, y, mean, weight) for each pixel.
template <class Set>
void PixelAccumulators::divide(int y0, int y1, int x0, int x1, const Set& set) {
    for (int y = y0; y < y1; ++y) {
        double* sum = rows_.at(x0, rows_.slot(y));
        for (int x = x0; x < x1; ++x, sum += kChannels) {
            set(x, y, glm::vec3(glm::dvec3(sum[0], sum[1], sum[2]) / sum[3]), sum[3]);
            std::fill_n(sum, kChannels, 0.0);
        }
    }
}

void PixelAccumulators::finish(int y0, int y1, int x0, int x1, film::Film& film) {
    divide(y0, y1, x0, x1, [&](int x, int y, const glm::vec3& radiance, double weight) {
        film.finish(x, y, radiance);
        if (!film.weights().empty()) film.set_weight(x, y, weight);
    });
}

void PixelAccumulators::finish_channel(int y0, int y1, int x0, int x1, std::size_t first, std::size_t count,
                                       film::Film& film) {
    divide(y0, y1, x0, x1, [&](int x, int y, const glm::vec3& value, double /*weight*/) {
        std::copy_n(&value.x, count, film.channels_at(x, y).subspan(first).begin());
    });
}

}  // namespace strata::estimate
