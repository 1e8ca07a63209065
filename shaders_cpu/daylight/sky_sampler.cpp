#include "shaders_cpu/daylight/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strata::shaders {
namespace {

constexpr int kRows = 32;
constexpr int kColumns = 64;
constexpr double kCellSolidAngle = 2.0 * std::numbers::pi / (kRows * kColumns);
constexpr double kBesideCosine = 0.2;
constexpr double kEven = 0.01;

glm::dvec3 direction_of(double y, double turns) {
    const double level = std::sqrt(std::max(0.0, 1.0 - y * y));
    return {level * std::cos(2.0 * std::numbers::pi * turns), y, level * std::sin(2.0 * std::numbers::pi * turns)};
}

// Which interval of a cumulated density u falls into, and how far.
struct Found {
    int index;
    double fraction;
};

Found find(const double* cumulated, int count, double u) {
    const int index =
        std::min(static_cast<int>(std::upper_bound(cumulated, cumulated + count, u) - cumulated), count - 1);
    const double from = index > 0 ? cumulated[index - 1] : 0.0;
    return {index, std::clamp((u - from) / (cumulated[index] - from), 0.0, 1.0)};
}

}  // namespace

SkySampler::SkySampler(const std::function<double(const glm::dvec3&)>& luminance)
    : probability_(kRows * kColumns), rows_(kRows), in_row_(kRows * kColumns) {
    double sum = 0.0;
    for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kColumns; ++j) {
            // Four points a cell.
            double weight = 0.0;
            for (const double y : {i + 0.25, i + 0.75})
                for (const double turns : {j + 0.25, j + 0.75})
                    weight += std::max(0.0, luminance(direction_of(y / kRows, turns / kColumns))) *
                              (y / kRows + kBesideCosine);
            probability_[i * kColumns + j] = weight;
            sum += weight;
        }
    double all = 0.0;
    for (int i = 0; i < kRows; ++i) {
        double row = 0.0;
        for (int j = 0; j < kColumns; ++j) {
            double& p = probability_[i * kColumns + j];
            const double even = 1.0 / (kRows * kColumns);
            p = sum > 0.0 ? (1.0 - kEven) * p / sum + kEven * even : even;
            in_row_[i * kColumns + j] = row += p;
        }
        for (int j = 0; j < kColumns; ++j) in_row_[i * kColumns + j] /= row;
        rows_[i] = all += row;
    }
    for (double& row : rows_) row /= all;
}

SkySample SkySampler::sample(double u0, double u1) const {
    const Found row = find(rows_.data(), kRows, u0);
    const Found column = find(&in_row_[row.index * kColumns], kColumns, u1);
    return {direction_of((row.index + row.fraction) / kRows, (column.index + column.fraction) / kColumns),
            probability_[row.index * kColumns + column.index] / kCellSolidAngle};
}

double SkySampler::pdf(const glm::dvec3& direction) const {
    if (direction.y < 0.0) return 0.0;
    const double turns = std::atan2(direction.z, direction.x) / (2.0 * std::numbers::pi);
    const int row = std::min(static_cast<int>(direction.y * kRows), kRows - 1);
    const int column = std::clamp(static_cast<int>((turns < 0.0 ? turns + 1.0 : turns) * kColumns), 0, kColumns - 1);
    return probability_[row * kColumns + column] / kCellSolidAngle;
}

}  // namespace strata::shaders
