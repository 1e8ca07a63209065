#include "src/accel/sun_beams.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/accel/interleave_simd.h"
#include "src/trace/rounding_pad.h"

namespace strata::accel {

namespace {

constexpr int kLevels = 13;  // 0 is the finest
constexpr int kCodeAxisBits = kLevelBits * (kLevels - 1);
constexpr int kCodeBits = 2 * kCodeAxisBits;       // of the code within a coarsest cell
constexpr double kFineCells = 1 << kCodeAxisBits;  // along a side of a coarsest cell

// The finest cells hold about this many rays. Speed only.
constexpr double kShadowRaysALeaf = 40.0;

// The sun must stand at least this high (sine) over the plane that holds what no ball does.
constexpr double kLeastRise = 1e-3;

glm::dvec3 across(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                             : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                                  : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(glm::cross(direction, other));
}

// The coarsest cells are as wide as the coarsest octave's lattice: wider beams would hardly come down at all.
double coarsest_side(const trace::Field& field) {
    if (field.relief() != nullptr) return 1.0 / field.relief()->coarsest_frequency();
    return field.octaves().empty() ? 1.0 : 1.0 / field.octaves().front().frequency;
}

std::uint64_t rank_of(std::vector<SunlitCells::Top>& tops, const SunlitCells::Top& top) {
    const auto same = [&](const SunlitCells::Top& other) { return other.a == top.a && other.b == top.b; };
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
    const solid::Extent extent = field.extent();
    const bool is_bounded = std::isfinite(extent.ball);
    bounding_ball_ = is_bounded ? extent.ball * trace::kRoundingPad : 0.0;
    up_ = extent.up;
    rise_ = glm::dot(up_, to_sun);
    usable_ = field.evaluations() > 0 && (is_bounded || rise_ > kLeastRise);
}

int SunBeams::level_of(double spacing) const {
    const double finer = std::log2(top_side_ / (spacing * std::sqrt(kShadowRaysALeaf))) / kLevelBits;
    return kLevels - 1 - static_cast<int>(std::clamp(std::ceil(finer), 0.0, kLevels - 1.0));
}

// By the coarsest cell, in the order of meeting, then by the Morton code in it.
void SunBeams::sort(std::span<const trace::Ray> rays, std::span<const double> spacing, SunlitCells& cells) const {
    const double fine_side = top_side_ / kFineCells;
    const std::size_t count = rays.size();
    cells.tops.clear();
    cells.a.resize(count);
    cells.b.resize(count);
    cells.ranks.resize(count);
    cells.levels.resize(count);
    cells.rays.codes.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double a = std::floor(glm::dot(rays[i].origin, a_) / fine_side);
        const double b = std::floor(glm::dot(rays[i].origin, b_) / fine_side);
        const double top_a = std::floor(a / kFineCells), top_b = std::floor(b / kFineCells);
        cells.ranks[i] = rank_of(cells.tops, {static_cast<std::int64_t>(top_a), static_cast<std::int64_t>(top_b)});
        cells.a[i] = a - top_a * kFineCells - 0.5 * kFineCells;
        cells.b[i] = b - top_b * kFineCells - 0.5 * kFineCells;
        cells.levels[i] = level_of(spacing[i]);
    }
    interleave_columns(cells.a, cells.b, 1.0, 0.5 * kFineCells, cells.rays.codes);
    for (std::size_t i = 0; i < count; ++i) cells.rays.codes[i] |= cells.ranks[i] << kCodeBits;
    cells.rays.sort();
}

// Around a cell, from where all is free; top_height is the height towards the sun of the beam's beginning.
trace::Beam SunBeams::beam(const SunlitCells& cells, std::uint64_t code, int level, double* top_height) const {
    const int bits = kCodeBits - 2 * kLevelBits * level;
    const SunlitCells::Top& top = cells.tops[code >> bits];
    const std::uint64_t inner = code & ((std::uint64_t{1} << bits) - 1);
    const double side = std::ldexp(top_side_, kLevelBits * (level - kLevels + 1));
    const Square at = square_of(inner);
    const double a = static_cast<double>(top.a) * top_side_ + (static_cast<double>(at.column) + 0.5) * side;
    const double b = static_cast<double>(top.b) * top_side_ + (static_cast<double>(at.row) + 0.5) * side;
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
        *top_height = (high - glm::dot(up_, foot)) / rise_;
        depth = 2.0 * high / rise_;
    }
    beam.origin = foot + *top_height * to_sun_;
    beam.limit = depth;
    return beam;
}

// What a node has reached is a height towards the sun, over which its rays are free; it comes down. A beam's frame is
// the height of its beginning.
class SunBeams::Descent {
  public:
    using Frame = double;

    Descent(const SunBeams& beams, const SunlitCells& cells, std::span<trace::Ray> rays)
        : beams_(beams), cells_(cells), rays_(rays) {}

    int levels() const { return kLevels; }
    std::span<const std::uint64_t> codes() const { return cells_.rays.codes; }
    int shift(int level) const { return 2 * kLevelBits * level; }

    // Cells whose rays all asked for coarser ones are not.
    bool is_wanted(int level, std::uint32_t first, std::uint32_t last) const {
        const auto order = std::span(cells_.rays.order).subspan(first, last - first);
        return std::ranges::any_of(order, [&](std::uint32_t ray) { return cells_.levels[ray] <= level; });
    }

    trace::Beam place(int level, std::uint64_t code, const CellNode& parent, double& top_height) const {
        trace::Beam beam = beams_.beam(cells_, code, level, &top_height);
        beam.start = std::max(0.0, top_height - parent.reached);
        return beam;
    }

    // The rays that asked for this cell have their limits; of a cell that meets nothing no ray needs following.
    bool note(int level, CellNode& node, double top_height, const trace::Beam& /*beam*/, const trace::BeamEnd& end) {
        node.reached = std::min(node.reached, top_height - end.s);
        node.hint = end.hint;
        for (const std::uint32_t i : std::span(cells_.rays.order).subspan(node.first, node.last - node.first)) {
            trace::Ray& ray = rays_[i];
            if (end.misses) ray.limit = 0.0;
            if (end.misses || cells_.levels[i] != level) continue;
            const double height = glm::dot(ray.origin, beams_.to_sun_);
            const double slack = 1e-12 * (std::abs(height) + std::abs(node.reached));
            ray.limit = std::min(ray.limit, std::max(0.0, node.reached - height + slack));
        }
        return !end.misses;
    }

  private:
    const SunBeams& beams_;
    const SunlitCells& cells_;
    std::span<trace::Ray> rays_;
};

void SunBeams::shorten(std::span<trace::Ray> rays, std::span<const double> spacing, SunlitCells& cells,
                       trace::TraceCounters& counters) const {
    sort(rays, spacing, cells);
    Descent descent(*this, cells, rays);
    descend(descent, std::numeric_limits<double>::infinity(), tracer_, cells.tree, counters);
}

}  // namespace strata::accel
