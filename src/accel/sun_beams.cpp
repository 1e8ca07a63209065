#include "src/accel/sun_beams.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/accel/bounding_ball.h"
#include "src/trace/rounding_pad.h"

namespace strata::accel {

namespace {

constexpr int kLevelBits = 2;  // a level's cells are 4 times narrower than their parents
constexpr int kLevels = 13;    // 0 is the finest
constexpr int kCodeBits = 2 * kLevelBits * (kLevels - 1);

// The finest cells hold about this many rays. Speed only.
constexpr double kRaysALeaf = 40.0;

// The sun must stand at least this high (sine) over a height field's plane.
constexpr double kLeastRise = 1e-3;

glm::dvec3 across(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                             : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                                  : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(glm::cross(direction, other));
}

std::uint64_t interleave(std::uint64_t x) {
    x = (x | x << 16) & 0x0000'ffff'0000'ffff;
    x = (x | x << 8) & 0x00ff'00ff'00ff'00ff;
    x = (x | x << 4) & 0x0f0f'0f0f'0f0f'0f0f;
    x = (x | x << 2) & 0x3333'3333'3333'3333;
    return (x | x << 1) & 0x5555'5555'5555'5555;
}

std::uint64_t every_other(std::uint64_t x) {
    x &= 0x5555'5555'5555'5555;
    x = (x | x >> 1) & 0x3333'3333'3333'3333;
    x = (x | x >> 2) & 0x0f0f'0f0f'0f0f'0f0f;
    x = (x | x >> 4) & 0x00ff'00ff'00ff'00ff;
    x = (x | x >> 8) & 0x0000'ffff'0000'ffff;
    return (x | x >> 16) & 0xffff'ffff;
}

// The coarsest cells are as wide as the coarsest octave's lattice: wider beams would hardly come down at all.
double coarsest_side(const trace::Field& field) {
    return field.octaves().empty() ? 1.0 : 1.0 / field.octaves().front().frequency;
}

std::uint64_t rank_of(std::vector<SunlitCells::Index>& tops, const SunlitCells::Index& top) {
    const auto same = [&](const SunlitCells::Index& other) { return other.a == top.a && other.b == top.b; };
    const auto found = std::ranges::find_if(tops, same);
    const auto rank = static_cast<std::uint64_t>(found - tops.begin());
    if (found == tops.end()) tops.push_back(top);
    return rank;
}

}  // namespace

SunBeams::SunBeams(const trace::Field& field, const glm::dvec3& to_sun, const glm::dvec3& noise_shift)
    : tracer_(field),
      to_sun_(to_sun),
      a_(across(to_sun)),
      b_(glm::cross(to_sun, a_)),
      noise_shift_(noise_shift),
      top_side_(coarsest_side(field)),
      amplitude_(field.amplitude()) {
    const double ball = bounding_ball(field);
    const bool is_bounded = std::isfinite(ball);
    bounding_ball_ = is_bounded ? ball : 0.0;
    usable_ = !field.octaves().empty() && (is_bounded || to_sun.y > kLeastRise);
}

int SunBeams::level_of(double spacing) const {
    const double finer = std::log2(top_side_ / (spacing * std::sqrt(kRaysALeaf))) / kLevelBits;
    return kLevels - 1 - static_cast<int>(std::clamp(std::ceil(finer), 0.0, kLevels - 1.0));
}

// By the coarsest cell, in the order of meeting, then by the Morton code in it.
void SunBeams::sort(std::span<const trace::Ray> rays, std::span<const double> spacing, SunlitCells& cells) const {
    const double fine_side = std::ldexp(top_side_, -kLevelBits * (kLevels - 1));
    const double fine_cells = std::ldexp(1.0, kLevelBits * (kLevels - 1));
    cells.entries.clear();
    cells.tops.clear();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double a = std::floor(glm::dot(rays[i].origin, a_) / fine_side);
        const double b = std::floor(glm::dot(rays[i].origin, b_) / fine_side);
        const double top_a = std::floor(a / fine_cells), top_b = std::floor(b / fine_cells);
        const std::uint64_t rank =
            rank_of(cells.tops, {static_cast<std::int64_t>(top_a), static_cast<std::int64_t>(top_b)});
        const auto fine_a = static_cast<std::uint64_t>(a - top_a * fine_cells);
        const auto fine_b = static_cast<std::uint64_t>(b - top_b * fine_cells);
        const std::uint64_t code = rank << kCodeBits | interleave(fine_a) | interleave(fine_b) << 1;
        cells.entries.push_back({code, static_cast<std::uint32_t>(i), level_of(spacing[i])});
    }
    std::ranges::sort(cells.entries, {}, &SunlitCells::Entry::code);
}

// Around a cell, from where all is free; top_height is the height towards the sun of the beam's beginning.
trace::Beam SunBeams::beam(const SunlitCells& cells, std::uint64_t code, int level, double* top_height) const {
    const int bits = kCodeBits - 2 * kLevelBits * level;
    const SunlitCells::Index& top = cells.tops[code >> bits];
    const std::uint64_t inner = code & ((std::uint64_t{1} << bits) - 1);
    const double side = std::ldexp(top_side_, kLevelBits * (level - kLevels + 1));
    const double a = static_cast<double>(top.a) * top_side_ + (static_cast<double>(every_other(inner)) + 0.5) * side;
    const double b =
        static_cast<double>(top.b) * top_side_ + (static_cast<double>(every_other(inner >> 1)) + 0.5) * side;
    const double slack = 1e-9 * (std::abs(a) + std::abs(b) + bounding_ball_ + amplitude_);
    const glm::dvec3 foot = a * a_ + b * b_;
    trace::Beam beam;
    beam.radius0 = std::sqrt(0.5) * side * trace::kRoundingPad + slack;
    beam.direction = -to_sun_;
    beam.noise_shift = noise_shift_;
    double depth = 0.0;
    if (bounding_ball_ > 0.0) {
        const double reach = bounding_ball_ + slack;
        const double off = std::max(0.0, std::hypot(a, b) - beam.radius0);
        *top_height = off < reach ? std::sqrt(reach * reach - off * off) : 0.0;
        depth = 2.0 * *top_height;
    } else {
        // The height at which every point of the cell is over the highest ground, and that below the deepest.
        const double high = amplitude_ + beam.radius0 + slack;
        *top_height = (high - foot.y) / to_sun_.y;
        depth = 2.0 * high / to_sun_.y;
    }
    beam.origin = foot + *top_height * to_sun_;
    beam.limit = depth;
    return beam;
}

void SunBeams::split(int level, SunlitCells& cells) const {
    const int shift = 2 * kLevelBits * level;
    cells.children.clear();
    cells.beams.clear();
    cells.top_height.clear();
    for (const SunlitCells::Node& node : cells.nodes) {
        for (std::uint32_t i = node.first; i < node.last;) {
            const std::uint64_t code = cells.entries[i].code >> shift;
            bool is_wanted = false;
            std::uint32_t end = i;
            for (; end < node.last && cells.entries[end].code >> shift == code; ++end) {
                is_wanted |= cells.entries[end].level <= level;
            }
            if (is_wanted) {
                double top_height = 0.0;
                trace::Beam beam = this->beam(cells, code, level, &top_height);
                beam.start = std::max(0.0, top_height - node.free_above);
                beam.hint = node.hint;
                cells.beams.push_back(beam);
                cells.top_height.push_back(top_height);
                cells.children.push_back({i, end, node.free_above, node.hint});
            }
            i = end;
        }
    }
}

// Rays whose own cells these are have their limits; the others go on to the next level.
void SunBeams::keep(int level, std::span<trace::Ray> rays, SunlitCells& cells) const {
    cells.nodes.clear();
    for (std::size_t i = 0; i < cells.children.size(); ++i) {
        SunlitCells::Node node = cells.children[i];
        const trace::BeamEnd& end = cells.ends[i];
        node.free_above = std::min(node.free_above, cells.top_height[i] - end.s);
        if (end.misses) node.free_above = -std::numeric_limits<double>::infinity();
        node.hint = end.hint;
        for (std::uint32_t k = node.first; k < node.last; ++k) {
            const SunlitCells::Entry& entry = cells.entries[k];
            if (entry.level != level && !end.misses) continue;
            trace::Ray& ray = rays[entry.ray];
            const double height = glm::dot(ray.origin, to_sun_);
            const double slack = 1e-12 * (std::abs(height) + std::abs(node.free_above));
            ray.limit = std::min(ray.limit, std::max(0.0, node.free_above - height + slack));
        }
        if (level > 0 && !end.misses) cells.nodes.push_back(node);
    }
}

void SunBeams::shorten(std::span<trace::Ray> rays, std::span<const double> spacing, SunlitCells& cells,
                       trace::TraceCounters& counters) const {
    sort(rays, spacing, cells);
    cells.nodes.assign(1, {0, static_cast<std::uint32_t>(rays.size()), std::numeric_limits<double>::infinity(), 0.0f});
    for (int level = kLevels - 1; level >= 0 && !cells.nodes.empty(); --level) {
        split(level, cells);
        cells.ends.resize(cells.beams.size());
        tracer_.trace(cells.beams, cells.ends, counters);
        keep(level, rays, cells);
    }
}

}  // namespace strata::accel
