#include "src/accel/screen_cells.h"

#include <algorithm>
#include <cmath>

#include "src/accel/interleave_simd.h"

namespace strata::accel {

namespace {

constexpr double kCoarsest = 64.0;  // px, at least

// Columns and rows of the finest cells are counted from here, so that none is negative; kAxisBits hold them.
constexpr int kAxisBits = 26;
constexpr double kBias = 1 << (kAxisBits - 1);

// Covers the rounding of a time's interval.
constexpr double kTimeSlack = 1e-9;

constexpr double power_of_two(int exponent) { return static_cast<double>(std::uint64_t{1} << exponent); }

constexpr std::uint64_t low_bits(std::uint64_t x, int count) { return x & ((std::uint64_t{1} << count) - 1); }

}  // namespace

ScreenHierarchy::ScreenHierarchy(double leaf, int time_bits, const scene::TimeSpan& shutter)
    : leaf_(leaf),
      cells_a_pixel_(1.0 / leaf),
      levels_(1),
      time_bits_(std::clamp(time_bits, 0, kMostTimeBits)),
      shutter_(shutter),
      interval_((shutter.last - shutter.first) / (1 << time_bits_)) {
    for (double side = leaf; side < kCoarsest; side *= 1 << kLevelBits) ++levels_;
    while (time_bits_at(levels_ - 1) > 0) ++levels_;
}

double ScreenHierarchy::side(int level) const { return leaf_ * power_of_two(kLevelBits * level); }

int ScreenHierarchy::time_bits_at(int level) const { return std::max(0, time_bits_ - kLevelBits * level); }

int ScreenHierarchy::shift(int level) const { return 2 * kLevelBits * level + time_bits_ - time_bits_at(level); }

// From the top: the coarsest cell's column and row interleaved, then for each finer level two bits of each and the
// level's bits of the time.
std::uint64_t ScreenHierarchy::with_time(std::uint64_t square, double t) const {
    const double most = (1 << time_bits_) - 1;
    const auto time = static_cast<std::uint64_t>(std::clamp(std::floor((t - shutter_.first) / interval_), 0.0, most));
    std::uint64_t code = square >> (2 * kLevelBits * (levels_ - 1));
    for (int level = levels_ - 2; level >= 0; --level) {
        const int new_bits = time_bits_at(level) - time_bits_at(level + 1);
        code = code << (2 * kLevelBits) | low_bits(square >> (2 * kLevelBits * level), 2 * kLevelBits);
        code = code << new_bits | low_bits(time >> (time_bits_ - time_bits_at(level)), new_bits);
    }
    return code;
}

// Leaves are wide enough for every frame to lie within kBias of them.
void ScreenHierarchy::codes(std::span<const double> u, std::span<const double> v, std::span<const double> t,
                            std::span<std::uint64_t> out) const {
    interleave_columns(u, v, cells_a_pixel_, kBias, out);
    if (time_bits_ == 0) return;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = with_time(out[i], t[i]);
}

std::uint64_t ScreenHierarchy::code(double u, double v, double t) const {
    std::uint64_t code = 0;
    codes({&u, 1}, {&v, 1}, {&t, 1}, {&code, 1});
    return code;
}

ScreenCell ScreenHierarchy::cell(std::uint64_t shifted, int level) const {
    std::uint64_t square = 0, time = 0;
    int square_shift = 0, time_shift = 0;
    for (int at = level; at < levels_ - 1 && time_bits_ > 0; ++at) {
        const int new_bits = time_bits_at(at) - time_bits_at(at + 1);
        time |= low_bits(shifted, new_bits) << time_shift;
        time_shift += new_bits;
        shifted >>= new_bits;
        square |= low_bits(shifted, 2 * kLevelBits) << square_shift;
        square_shift += 2 * kLevelBits;
        shifted >>= 2 * kLevelBits;
    }
    square |= shifted << square_shift;
    const double bias = kBias / power_of_two(kLevelBits * level);
    ScreenCell cell;
    cell.side = side(level);
    const Square at = square_of(square);
    cell.x = (static_cast<double>(at.column) - bias) * cell.side;
    cell.y = (static_cast<double>(at.row) - bias) * cell.side;
    const double length = interval_ * static_cast<double>(1 << (time_bits_ - time_bits_at(level)));
    const double first = shutter_.first + static_cast<double>(time) * length;
    const double slack = kTimeSlack * (shutter_.last - shutter_.first);
    cell.time = {first - slack, first + length + slack};
    return cell;
}

}  // namespace strata::accel
