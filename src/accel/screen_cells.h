// A fixed hierarchy of screen cells over the frame and the shutter: squares of absolute frame coordinates and, where
// the scene moves, intervals of time; each level 2^kLevelBits times finer than the one above. Which cell a sample
// belongs to depends on the sample alone.
#pragma once

#include <cstdint>
#include <span>

#include "src/accel/cell_tree.h"
#include "src/scene/camera_path.h"

namespace strata::accel {

// Points of the screen in [x, x + side) x [y, y + side) px, at times [first, last].
struct ScreenCell {
    double x = 0.0;
    double y = 0.0;
    double side = 0.0;
    scene::TimeSpan time;
};

class ScreenHierarchy {
  public:
    static constexpr int kMostTimeBits = 12;  // at most 2^kMostTimeBits intervals

    // leaf: side of the finest cells, a power of two, px. shutter: the times of all samples, which time_bits divides
    // into 2^time_bits intervals at the finest level.
    ScreenHierarchy(double leaf, int time_bits, const scene::TimeSpan& shutter);

    // Level 0 is the finest.
    int levels() const { return levels_; }
    double side(int level) const;

    std::uint64_t code(double u, double v, double t) const;

    // The codes of many samples; the four spans have equal length.
    void codes(std::span<const double> u, std::span<const double> v, std::span<const double> t,
               std::span<std::uint64_t> out) const;

    // Codes of samples in the same cell of a level are equal after this shift, and only theirs.
    int shift(int level) const;

    // shifted: a code, shifted for the level.
    ScreenCell cell(std::uint64_t shifted, int level) const;

  private:
    int time_bits_at(int level) const;
    std::uint64_t with_time(std::uint64_t square, double t) const;

    double leaf_;
    double cells_a_pixel_;  // exact: leaf_ is a power of two
    int levels_;
    int time_bits_;
    scene::TimeSpan shutter_;
    double interval_;  // of time at the finest level, s
};

}  // namespace strata::accel
