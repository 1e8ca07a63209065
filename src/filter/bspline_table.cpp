#include "src/filter/bspline_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "src/filter/bspline.h"
#include "src/filter/bspline_table_simd.h"

namespace strata::filter {

namespace {

constexpr float kDeepestFloor = 0x1p-35f;
constexpr float kCentre = 0.5f;

// Elements between looks for values below the table.
constexpr std::size_t kChunk = 1024;

// Beyond this distance from the centre a float's own spacing leaves no room for kTableError.
constexpr double kTableReach = 8.0;  // px

std::int32_t cell_of(float p) { return std::bit_cast<std::int32_t>(p) >> detail::kCellShift; }

float cell_start(std::int32_t cell) { return std::bit_cast<float>(cell << detail::kCellShift); }

// The distance of the coordinate from the centre.
double distance(int m, double p) { return 0.5 * m - bspline_inverse_tail(m, p); }

// Interpolates distance() at the four Chebyshev points of the cell, t in [-1/2,1/2], by Newton's divided differences.
detail::Cubic fit_cell(int m, std::int32_t cell) {
    const double low = cell_start(cell);
    const double high = cell_start(cell + 1);
    std::array<double, 4> t{};
    std::array<double, 4> divided{};
    for (std::size_t i = 0; i < 4; ++i) {
        t[i] = 0.5 * std::cos((static_cast<double>(i) + 0.5) * std::numbers::pi / 4);
        divided[i] = distance(m, low + (t[i] + 0.5) * (high - low));
    }
    for (std::size_t level = 1; level < 4; ++level) {
        for (std::size_t i = 3; i >= level; --i) divided[i] = (divided[i] - divided[i - 1]) / (t[i] - t[i - level]);
    }

    // Expand to powers of t by Horner's rule on polynomials.
    std::array<double, 4> power{divided[3], 0, 0, 0};
    for (std::size_t i = 3; i-- > 0;) {
        for (std::size_t k = 3; k > 0; --k) power[k] = power[k - 1] - t[i] * power[k];
        power[0] = divided[i] - t[i] * power[0];
    }
    detail::Cubic cubic{};
    for (std::size_t k = 0; k < 4; ++k) cubic.coefficients[k] = static_cast<float>(power[k]);
    return cubic;
}

// The first cell that the table can answer to kTableError.
std::int32_t first_cell(int m) {
    std::int32_t cell = cell_of(kDeepestFloor);
    while (distance(m, cell_start(cell)) > kTableReach) ++cell;
    return cell;
}

}  // namespace

BsplineTable::BsplineTable(int m) : order_(m), table_floor_(2 * kCentre) {
    assert(m >= kMinOrder && m <= kMaxOrder);
    if (m > kMaxTableOrder) return;
    first_cell_ = first_cell(m);
    last_cell_ = cell_of(kCentre);
    table_floor_ = cell_start(first_cell_);
    cubics_.reserve(static_cast<std::size_t>(last_cell_) - static_cast<std::size_t>(first_cell_) + 1);
    for (std::int32_t cell = first_cell_; cell < last_cell_; ++cell) cubics_.push_back(fit_cell(m, cell));
    // |q| = 1/2 starts a cell of its own, which is the centre.
    cubics_.push_back({});
}

float BsplineTable::exact(float q) const {
    const float p = std::abs(q) <= kCentre ? std::abs(q) : kCentre;
    return std::copysign(static_cast<float>(distance(order_, p)), q);
}

void BsplineTable::centred(std::span<const float> q, std::span<float> x) const {
    assert(q.size() == x.size());
    if (cubics_.empty()) {
        std::transform(q.begin(), q.end(), x.begin(), [this](float value) { return exact(value); });
        return;
    }
    for (std::size_t begin = 0; begin < q.size(); begin += kChunk) {
        const std::size_t count = std::min(kChunk, q.size() - begin);
        const auto q_chunk = q.subspan(begin, count);
        const auto x_chunk = x.subspan(begin, count);
        if (!detail::evaluate_cubics({cubics_.data(), first_cell_, last_cell_}, q_chunk.data(), count, x_chunk.data()))
            continue;
        for (std::size_t i = 0; i < count; ++i) {
            if (std::abs(q_chunk[i]) < table_floor_) x_chunk[i] = exact(q_chunk[i]);
        }
    }
}

float BsplineTable::centred(float q) const {
    float x = 0;
    centred({&q, 1}, {&x, 1});
    return x;
}

}  // namespace strata::filter
