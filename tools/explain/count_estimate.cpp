#include "tools/explain/count_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/render/confidence.h"

namespace strata::tools::explain {

namespace {

constexpr double kConfidence = 0.99;

// Where n blocks all agree, a part of the picture that none of them shows may have a share of 1 - (1 - p)^(1/n), about
// -ln(1 - p) / n, p being the confidence.
const double kUnseenBlocks = -std::log(1.0 - kConfidence);

struct Variance {
    double value = 0.0;
    double dof = 1.0;  // degrees of freedom of that estimate
};

// Squares of differences, each of which has the variance as its mean.
class Squares {
  public:
    void add(double square) {
        sum_ += square;
        fourth_ += square * square;
        ++count_;
    }
    bool any() const { return count_ > 0; }

    // Squares of n normal numbers of equal variance have (sum)^2 / (sum of squares) = n / 3; where few of them hold
    // most of the sum, as along the outline of a body, there is less to rely on. Lines and columns use each block
    // twice.
    Variance variance() const {
        if (!(fourth_ > 0.0)) return {};
        return {sum_ / static_cast<double>(count_), 3.0 * sum_ * sum_ / fourth_ / 2.0};
    }

  private:
    double sum_ = 0.0, fourth_ = 0.0;
    std::size_t count_ = 0;
};

// The variance of blocks that lie one in each of equal parts of the picture, within their parts. From three in a row or
// a column: a - 2 b + c has six times the variance, and is blind to what changes evenly from part to part, as pictures
// do towards a horizon. What does not comes on top, so that it errs upwards. Where there are no three, from two.
Variance variance_within_parts(const std::vector<double>& values, int columns) {
    const auto width = static_cast<std::size_t>(columns), rows = values.size() / width;
    Squares twos, threes;
    // Goes along a row or a column.
    const auto add_line = [&](std::size_t first, std::size_t stride, std::size_t count) {
        for (std::size_t k = 1; k < count; ++k) {
            const std::size_t i = first + k * stride;
            const double step = values[i] - values[i - stride];
            twos.add(step * step / 2.0);
            if (k == 1) continue;
            const double bend = step - (values[i - stride] - values[i - 2 * stride]);
            threes.add(bend * bend / 6.0);
        }
    };
    for (std::size_t y = 0; y < rows; ++y) add_line(y * width, 1, width);
    for (std::size_t x = 0; x < width; ++x) add_line(x, width, rows);
    return (threes.any() ? threes : twos).variance();
}

// Of the sum over all blocks: what chance may add or take, from what each has more or less than the mean of all rays.
double chance(const PilotRun& pilot, const BlockCount& count, double mean) {
    std::vector<double> residual;
    for (const integrate::Counters& block : pilot.by_block) {
        residual.push_back(count.of(block) - mean * static_cast<double>(block.rays));
    }
    constexpr double kLeastDof = 3.0;  // with fewer the interval would tell nothing
    const auto blocks = static_cast<double>(residual.size());
    const Variance variance = variance_within_parts(residual, pilot.columns);
    const double dof = std::clamp(variance.dof, kLeastDof, std::max(kLeastDof, blocks - 1.0));
    return std::sqrt(blocks * variance.value) *
           render::student_quantile(0.5 + 0.5 * kConfidence, static_cast<int>(dof));
}

}  // namespace

CountEstimate estimate_count(const PilotRun& pilot, double rays, const BlockCount& count) {
    double total = 0.0, doubt = 0.0;
    for (const integrate::Counters& block : pilot.by_block) {
        total += count.of(block);
        if (count.doubt) doubt += count.doubt(block);
    }
    const auto blocks = static_cast<double>(pilot.by_block.size());
    const auto pilot_rays = static_cast<double>(pilot.counters.rays);
    const double scale = rays / pilot_rays;
    const double unseen = std::max(0.0, 1.0 - 1.0 / scale);  // share of the rays that the pilot has not cast
    double half_width = scale * std::sqrt(unseen) * chance(pilot, count, total / pilot_rays);
    const double most = count.most_a_ray.value_or(0.0) * rays;
    if (half_width == 0.0) half_width = most * unseen * std::min(1.0, kUnseenBlocks / blocks);
    half_width += scale * doubt;
    // What the pilot's samples did the render's do as well.
    CountEstimate estimate{scale * total, std::max(total - doubt, scale * total - half_width),
                           scale * total + half_width};
    if (count.most_a_ray) estimate.high = std::min(estimate.high, most);
    return estimate;
}

}  // namespace strata::tools::explain
