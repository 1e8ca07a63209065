#include "src/accel/zones.h"

#include <algorithm>

#include "src/trace/rounding_pad.h"

namespace strata::accel {

namespace {

// Speed only, all of them. The first jump after a touch, in radii of the beam, and how jumps grow where the beam does
// not get on.
constexpr double kFirstJump = 4.0;
constexpr double kJumpGrowth = 2.0;

// A beam that gained less than so many radii before it touched again does not part two zones.
constexpr double kLeastFree = 3.0;

// Where f is so many radii below 0 on the axis, all of the bundle is taken to have hit.
constexpr double kSolid = 4.0;

// Rays at distances from this one on have passed the axis coordinate s.
double distance_behind(const CellBeam& cell, double s) { return s / cell.margins.cosine * trace::kRoundingPad; }

// Rays at distances up to this one have not reached the axis coordinate s.
double distance_before(const CellBeam& cell, double s) { return (s - cell.margins.shift) * trace::kSooner; }

}  // namespace

void ZoneList::put(const Zone& zone) {
    if (count < kMost) {
        std::size_t i = count++;
        for (; i > 0 && zones[i - 1].from > zone.from; --i) zones[i] = zones[i - 1];
        zones[i] = zone;
        return;
    }
    Zone& last = zones[kMost - 1];
    const double to = std::max(last.to, zone.to);
    if (zone.from < last.from) {
        // The first of what is merged tells how to go on.
        std::size_t i = kMost - 1;
        last = zone;
        for (; i > 0 && zones[i - 1].from > zones[i].from; --i) std::swap(zones[i - 1], zones[i]);
        zones[kMost - 1].to = to;
        return;
    }
    last.to = to;
}

void ZoneList::merge_from(double distance) {
    std::uint32_t i = 0;
    while (i < count && zones[i].from < distance) ++i;
    if (i >= count) return;
    zones[i].to = zones[count - 1].to;
    count = i + 1;
}

// Every zone that went in becomes a walk, and leaves the list.
void ZoneTracer::begin(std::span<ZonedBundle> bundles, int jumps) {
    walks_.clear();
    solid_.assign(bundles.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t i = 0; i < bundles.size(); ++i) {
        ZonedBundle& bundle = bundles[i];
        const trace::Beam& beam = bundle.cell.beam;
        if (!(beam.limit > 0.0)) continue;
        for (const Zone& zone : bundle.zones.all()) {
            Walk walk;
            walk.bundle = i;
            walk.left = static_cast<std::uint32_t>(jumps);
            walk.at = std::max(beam.start, zone.from * bundle.cell.margins.cosine * trace::kSooner);
            walk.end = std::min(beam.limit, (zone.to + bundle.cell.margins.shift) * trace::kRoundingPad);
            walk.from = zone.from;
            walk.to = zone.to;
            walk.zone.hint = zone.hint;
            walks_.push_back(walk);
        }
        bundle.zones.count = 0;
    }
}

// What the walk's beam found. Whether it goes on.
bool ZoneTracer::goes_on(Walk& walk, const trace::BeamEnd& end, const CellBeam& cell, ZoneList& out, int jumps) {
    const auto leave_zone = [&](double to) {
        walk.zone.to = to;
        if (walk.touched) out.put(walk.zone);
    };
    if (end.misses) {
        leave_zone(std::min(walk.to, distance_behind(cell, walk.at)));
        return false;
    }
    const double radius = trace::radius_at(cell.beam, end.s);
    if (!walk.touched || end.s - walk.at > kLeastFree * radius) {
        leave_zone(std::min(walk.to, distance_behind(cell, walk.at)));
        walk.touched = true;
        walk.zone = {std::max(walk.from, distance_before(cell, end.s)), walk.to, end.s, end.slope, end.hint};
        walk.left = static_cast<std::uint32_t>(jumps);
        walk.jump = kFirstJump;
    }
    const bool is_solid = end.f < -kSolid * radius;
    if (is_solid) solid_[walk.bundle] = std::min(solid_[walk.bundle], walk.zone.from);
    walk.at = std::max(end.s, walk.at) + walk.jump * radius;
    walk.jump *= kJumpGrowth;
    if (walk.at < walk.end && walk.left > 0 && !is_solid) {
        --walk.left;
        return true;
    }
    leave_zone(walk.to);
    return false;
}

void ZoneTracer::follow(const trace::BeamTracer& tracer, std::span<ZonedBundle> bundles, int jumps,
                        trace::TraceCounters& counters) {
    begin(bundles, jumps);
    while (!walks_.empty()) {
        beams_.clear();
        for (const Walk& walk : walks_) {
            trace::Beam& beam = beams_.emplace_back(bundles[walk.bundle].cell.beam);
            beam.start = walk.at;
            beam.limit = walk.end;
            beam.hint = walk.zone.hint;
        }
        ends_.resize(beams_.size());
        tracer.trace(beams_, ends_, counters);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < walks_.size(); ++i) {
            Walk walk = walks_[i];
            ZonedBundle& bundle = bundles[walk.bundle];
            if (goes_on(walk, ends_[i], bundle.cell, bundle.zones, jumps)) walks_[kept++] = walk;
        }
        walks_.resize(kept);
    }
    for (std::size_t i = 0; i < bundles.size(); ++i) bundles[i].zones.merge_from(solid_[i]);
}

}  // namespace strata::accel
