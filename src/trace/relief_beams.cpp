// Bundles of rays through composed reliefs: an enclosure around the axis point that covers the bundle's radius and the
// hinted step gives a quadratic below f over the whole bundle.
#include <algorithm>

#include "src/trace/relief_tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/relief_beams.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/beam_packet-inl.h"
#include "src/trace/lane_bits-inl.h"
#include "src/trace/lower_bound-inl.h"
#include "src/trace/relief_enclosure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// As in relief_tracer.cpp. Speed only.
constexpr float kBeamAgain = 1.0f, kBeamGrow = 1.4f, kBeamShrink = 0.4f;

struct BeamStep {
    FloatVec safe, slope, radius;
};

// f on the axis point x, and the step over which the whole bundle stays outside. With D = t d + e, e across d and
// |e| <= radius + spread t, and n the noise's own displacement, |n| <= noise_radius, which `radius` has in it:
//
//   f >= base - r - slack(|D + n|) + (grad base - grad r) . D - grad r . n,
//   |D + n| <= radius + (speed + spread) t.
template <bool kPlanar>
HWY_INLINE BeamStep step_beam(const Field& field, const ReliefPlan& plan, const BeamPacket& packet,
                              TraceCounters& counters) {
    const FloatTag d;
    const FloatVec up = set(kRoundUp);
    const WidePoint direction = load_point(packet.direction);
    const Wide s = load_wide(packet.s), spread_wide = load_wide(packet.spread);
    const WidePoint x = point_at(load_point(packet.origin), direction, s);
    WidePoint noise_x = x;
    if (field.drifts()) noise_x = add(x, load_point(packet.noise_shift));
    const FloatVec radius = hn::Mul(to_float(mul_add(spread_wide, s, load_wide(packet.radius0))), up);
    const FloatVec spread = hn::Mul(to_float(spread_wide), up), drift = hn::Mul(hn::Load(d, packet.noise_radius), up);
    const FloatVec hint = hn::Load(d, packet.hint), pace = hn::Mul(hn::Add(hn::Load(d, packet.speed), spread), up);
    FloatVec evaluations = hn::Zero(d);
    auto broken = hn::Lt(evaluations, evaluations);
    const auto active = hn::Gt(hn::Load(d, packet.active), hn::Zero(d));
    const auto none = hn::Lt(hint, hn::Zero(d));
    const ReliefPoints points{
        hn::Mul(hn::MulAdd(hint, pace, radius), up), active, none, &counters, &evaluations, &broken};
    const Enclosure r = enclose<kPlanar>(plan, noise_x, packet.reach, points);

    const Base base = base_at<kPlanar>(field, x, direction);
    const FloatPoint axis = to_float(direction), base_gradient = base_gradient_at<kPlanar>(field, x);
    const FloatPoint gradient = {hn::Sub(base_gradient.x, r.gradient.x), hn::Sub(base_gradient.y, r.gradient.y),
                                 hn::Sub(base_gradient.z, r.gradient.z)};
    const FloatVec along = dot(gradient, axis);
    const FloatPoint across = mul_add(hn::Neg(along), axis, gradient);
    const FloatVec steep = length(r.gradient);
    const FloatVec off = hn::Mul(set(0x1p-21f), hn::Add(set(1.0f), steep));  // of both slopes
    const FloatVec pull = hn::MulAdd(length(across), up, off);
    const FloatVec error = hn::Mul(set(0x1p-22f), hn::Add(hn::Abs(base.value), hn::Abs(r.value)));
    FloatVec start = hn::Sub(hn::Sub(base.value, r.value), hn::Add(error, r.up.at(radius)));
    start = hn::Sub(start, hn::MulAdd(pull, radius, hn::Mul(hn::Mul(steep, up), drift)));
    const FloatVec twice = hn::Mul(set(2.0f), hn::Mul(r.up.e2, radius));
    const FloatVec rate =
        hn::Sub(hn::Sub(along, off), hn::MulAdd(pull, spread, hn::Mul(pace, hn::Add(r.up.e1, twice))));
    const FloatVec root = first_root(start, rate, hn::Mul(r.up.e2, hn::Mul(pace, pace)));
    return {hn::Min(root, hint), along, radius};
}

// Moves a lane, or ends it. Where the ball left out too much to tell, the next one is smaller.
HWY_INLINE void move_beam(BeamPacket& packet, std::size_t lane, float safe, float slope, float radius,
                          std::span<BeamEnd> ends) {
    const float least = kLeastGain * radius, hint = packet.hint[lane];
    packet.s[lane] += safe;
    const bool misses = safe > 0.0f && packet.s[lane] >= packet.limit[lane];
    const bool gains = safe > 0.0f && safe >= least;
    const bool may_shrink = !gains && hint > 2.0f * std::max(least, 1e-30f);
    const bool ends_here = misses || ++packet.steps[lane] >= kMostBeamSteps || !(gains || may_shrink);
    packet.hint[lane] = gains ? std::min((safe < hint ? kBeamAgain : kBeamGrow) * safe, 1e15f)
                              : std::max(kBeamShrink * hint, std::max(least, 1e-30f));
    if (!ends_here) return;
    ends[packet.beam[lane]] = {packet.s[lane], packet.hint[lane], slope, misses};
    packet.active[lane] = 0.0f;
    --packet.active_count;
}

template <bool kPlanar>
HWY_NOINLINE void trace_relief_beams_of(const Field& field, const ReliefPlan& plan, std::span<const Beam> beams,
                                        std::span<BeamEnd> ends, TraceCounters& counters) {
    const FloatTag d;
    const std::size_t lanes = hn::Lanes(d);
    BeamPacket packet;
    alignas(HWY_MAX_BYTES) float safe[kMaxLanes], slope[kMaxLanes], radius[kMaxLanes];
    for (std::size_t next = 0;;) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            while (packet.active[lane] == 0.0f && next < beams.size()) {
                const Beam& beam = beams[next];
                if (beam.start < beam.limit) {
                    take_beam(packet, lane, beam, next, plan.first_hint, kPlanar);
                } else {
                    ends[next] = {beam.start, beam.hint, 0.0f, true};
                }
                ++next;
            }
        }
        if (packet.active_count == 0) return;
        const BeamStep step = step_beam<kPlanar>(field, plan, packet, counters);
        hn::Store(step.safe, d, safe);
        hn::Store(step.slope, d, slope);
        hn::Store(step.radius, d, radius);
        counters.steps += packet.active_count;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (packet.active[lane] != 0.0f) move_beam(packet, lane, safe[lane], slope[lane], radius[lane], ends);
        }
    }
}

void TraceReliefBeams(const Field& field, const ReliefPlan& plan, std::span<const Beam> beams, std::span<BeamEnd> ends,
                      TraceCounters& counters) {
    by_dimensions(field,
                  [&](auto planar) HWY_ATTR { trace_relief_beams_of<planar()>(field, plan, beams, ends, counters); });
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(TraceReliefBeams);

void trace_relief_beams(const Field& field, const ReliefPlan& plan, std::span<const Beam> beams,
                        std::span<BeamEnd> ends, TraceCounters& counters) {
    HWY_DYNAMIC_DISPATCH(TraceReliefBeams)(field, plan, beams, ends, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
