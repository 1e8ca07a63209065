#include "src/accel/screen_cells.h"

#include <algorithm>
#include <array>
#include <bit>
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

std::uint64_t gather_bits(std::uint64_t x) {
    x &= 0x5555'5555'5555'5555;
    x = (x | x >> 1) & 0x3333'3333'3333'3333;
    x = (x | x >> 2) & 0x0f0f'0f0f'0f0f'0f0f;
    x = (x | x >> 4) & 0x00ff'00ff'00ff'00ff;
    x = (x | x >> 8) & 0x0000'ffff'0000'ffff;
    return (x | x >> 16) & 0xffff'ffff;
}

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
    cell.x = (static_cast<double>(gather_bits(square)) - bias) * cell.side;
    cell.y = (static_cast<double>(gather_bits(square >> 1)) - bias) * cell.side;
    const double length = interval_ * static_cast<double>(1 << (time_bits_ - time_bits_at(level)));
    const double first = shutter_.first + static_cast<double>(time) * length;
    const double slack = kTimeSlack * (shutter_.last - shutter_.first);
    cell.time = {first - slack, first + length + slack};
    return cell;
}

// By digits, the least first; each pass keeps the order of equal ones.
template <class Code>
void SortedSamples::Keys<Code>::sort(int bits) {
    constexpr int kDigit = 11;
    scratch.resize(keys.size());
    for (int shift = 0; shift < bits; shift += kDigit) {
        std::array<std::uint32_t, (1u << kDigit) + 1> start{};
        const auto digit = [&](const Key& key) { return low_bits(key.code >> shift, kDigit); };
        for (const Key& key : keys) ++start[digit(key) + 1];
        for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
        for (const Key& key : keys) scratch[start[digit(key)]++] = key;
        keys.swap(scratch);
    }
}

template <class Code>
void SortedSamples::sort_by(Keys<Code>& sorted, std::uint64_t least, int bits) {
    sorted.keys.resize(codes.size());
    for (std::size_t i = 0; i < codes.size(); ++i) {
        sorted.keys[i] = {static_cast<Code>(codes[i] - least), static_cast<std::uint32_t>(i)};
    }
    sorted.sort(bits);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        codes[i] = least + sorted.keys[i].code;
        order[i] = sorted.keys[i].sample;
    }
}

void SortedSamples::sort(const ScreenHierarchy& hierarchy, std::span<const double> u, std::span<const double> v,
                         std::span<const double> t) {
    codes.resize(u.size());
    order.resize(u.size());
    if (codes.empty()) return;
    hierarchy.codes(u, v, t, codes);
    const auto [least, most] = std::ranges::minmax(codes);
    const int bits = static_cast<int>(std::bit_width(most - least));
    if (bits <= 32) return sort_by(near_, least, bits);
    sort_by(scattered_, least, bits);
}

}  // namespace strata::accel
