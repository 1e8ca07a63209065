#include "src/trace/beam_tracer.h"

#include <algorithm>

#include "src/trace/relief_tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/beam_tracer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/base-inl.h"
#include "src/trace/beam_bound-inl.h"
#include "src/trace/beam_packet-inl.h"
#include "src/trace/lane_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// As in fast_tracer.cpp, of the step and the beam's radius together. Speed only.
constexpr float kBeamCellsAhead = 0.3f;

struct BeamCache {
    std::array<OctaveSample, noise::kMaxOctaves> sample;
    std::array<FloatVec, noise::kMaxOctaves> slope;
    std::array<FloatVec, noise::kMaxOctaves> used;  // 1 or 0
    std::size_t count = 0;
};

// What one step knows of every lane.
struct BeamPoint {
    FloatPoint axis;
    FloatPoint base_gradient;
    FloatVec certain;  // lower bound of f on the axis
};

// The octaves that the bounds rest on are left in `cache`.
template <bool kPlanar>
HWY_INLINE FloatVec evaluate_beam(const TracePlan& plan, const Field& field, const BeamPacket& packet,
                                  const WidePoint& x, const WidePoint& direction, FloatVec radius, BeamCache& cache,
                                  TraceCounters& counters) {
    const FloatTag d;
    const FloatPoint axis = to_float(direction);
    const Base base = base_at<kPlanar>(field, x, direction);
    const FloatVec error =
        hn::MulAdd(hn::Abs(base.value), hn::Set(d, plan.error_relative), hn::Set(d, plan.error_absolute));
    const FloatVec reach = hn::MulAdd(hn::Load(d, packet.hint), hn::Load(d, packet.speed), radius);
    WidePoint noise_x = x;
    if (field.drifts()) noise_x = add(x, load_point(packet.noise_shift));
    FloatVec f = base.value, unseen = hn::Zero(d);
    auto open = hn::Gt(hn::Load(d, packet.active), hn::Zero(d));
    cache.count = 0;
    for (const TraceOctave& octave : plan.octaves) {
        const FloatVec rest = hn::Set(d, octave.rest), wave = hn::Set(d, octave.wave);
        const auto doubtful = hn::Le(hn::Sub(f, rest), error);
        const auto wanted = hn::And(open, hn::Or(doubtful, hn::Le(hn::Mul(wave, reach), hn::Set(d, kBeamCellsAhead))));
        unseen = hn::IfThenElse(hn::AndNot(wanted, open), rest, unseen);
        open = wanted;
        if (hn::AllFalse(d, open)) break;
        const OctaveSample n = sample_octave<kPlanar>(octave, noise_x, packet.reach);
        FloatVec slope = hn::MulAdd(n.dx, axis.x, hn::Mul(n.dz, axis.z));
        if constexpr (!kPlanar) slope = hn::MulAdd(n.dy, axis.y, slope);
        f = hn::NegMulAdd(hn::IfThenElseZero(open, hn::Set(d, octave.amplitude)), n.value, f);
        cache.sample[cache.count] = n;
        cache.slope[cache.count] = slope;
        cache.used[cache.count++] = hn::IfThenElseZero(open, hn::Set(d, 1.0f));
        counters.noise_evaluations += hn::CountTrue(d, open);
        counters.executed_lanes += hn::Lanes(d);
    }
    return hn::Sub(f, hn::Add(unseen, error));
}

// The longest step that is certified to keep the whole beam outside the surface, by bounds chosen for span.ahead.
// noise_radius: how much of span.radius is the drifting noise's own; kLoose: it is not 0.
template <bool kPlanar, bool kLoose>
HWY_INLINE FloatVec solve_beam(const TracePlan& plan, const BeamCache& cache, const BeamPoint& at, const BeamSpan& span,
                               FloatVec noise_radius, FloatVec* slope) {
    const FloatTag d;
    BeamBounds bounds = no_beam_bounds();
    for (std::size_t k = 0; k < cache.count; ++k) {
        bounds = add_octave_beam<kPlanar, kLoose>(bounds, plan, plan.octaves[k], cache.sample[k], cache.slope[k], span,
                                                  hn::Gt(cache.used[k], hn::Zero(d)));
    }
    // The gradient across the axis, componentwise so that nothing cancels. Drift also leads along the axis.
    const FloatPoint gradient = {hn::Sub(at.base_gradient.x, bounds.gradient.x),
                                 hn::Sub(at.base_gradient.y, bounds.gradient.y),
                                 hn::Sub(at.base_gradient.z, bounds.gradient.z)};
    const FloatVec along = dot(gradient, at.axis);
    const FloatPoint across = {hn::NegMulAdd(along, at.axis.x, gradient.x), hn::NegMulAdd(along, at.axis.y, gradient.y),
                               hn::NegMulAdd(along, at.axis.z, gradient.z)};
    const FloatPoint& sideways = kLoose ? gradient : across;
    const FloatVec error = hn::Set(d, plan.slope_error);
    const FloatVec pull =
        hn::MulAdd(hn::Sqrt(dot(sideways, sideways)), hn::Set(d, static_cast<float>(kRoundUp)), error);
    FloatVec start = hn::Sub(at.certain, hn::MulAdd(pull, span.radius, bounds.drop));
    // The base does not drift: |grad base| <= 1 undoes what `pull` assumed.
    if constexpr (kLoose) start = hn::NegMulAdd(noise_radius, hn::Set(d, static_cast<float>(kRoundUp)), start);
    const FloatVec base_slope = hn::Sub(hn::Sub(dot(at.base_gradient, at.axis), error), hn::Mul(pull, span.spread));
    const FloatVec root = first_root(start, hn::MulAdd(base_slope, span.ahead, bounds.slope), bounds.bend);
    *slope = along;
    return hn::Mul(root, span.ahead);
}

// All active lanes by their safe steps; those that gained too little, or passed their limit, report and become idle.
HWY_INLINE void move_beams(BeamPacket& packet, const Wide& s, FloatVec safe, FloatVec least_gain, FloatVec slope,
                           FloatVec f, std::span<BeamEnd> ends, TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const auto active = hn::Gt(hn::Load(d, packet.active), hn::Zero(d));
    const WordVec steps =
        hn::Add(hn::Load(dw, packet.steps), hn::IfThenElseZero(hn::RebindMask(dw, active), hn::Set(dw, 1u)));
    hn::Store(steps, dw, packet.steps);
    counters.steps += hn::CountTrue(d, active);
    const Wide clear = add(s, to_wide(safe));
    store_wide(select(widen(active), clear, s), packet.s);
    const auto misses = hn::And(active, narrow(greater_equal(clear, load_wide(packet.limit))));
    const auto gains = hn::And(hn::Gt(safe, hn::Zero(d)), hn::Ge(safe, least_gain));
    const auto is_last = hn::RebindMask(d, hn::Eq(steps, hn::Set(dw, kMostBeamSteps)));
    const auto ends_here = hn::And(active, hn::Or(misses, hn::Or(hn::Not(gains), is_last)));
    if (hn::AllFalse(d, ends_here)) return;
    alignas(HWY_MAX_BYTES) float slopes[kMaxLanes], values[kMaxLanes];
    hn::Store(slope, d, slopes);
    hn::Store(f, d, values);
    const LaneSet missing(misses);
    for (const std::size_t lane : LaneSet(ends_here)) {
        ends[packet.beam[lane]] = {packet.s[lane], packet.hint[lane], slopes[lane], missing.contains(lane),
                                   values[lane]};
        packet.active[lane] = 0.0f;
        --packet.active_count;
    }
}

// One step of every active lane.
template <bool kPlanar, bool kLoose>
HWY_INLINE void step_beams(const Field& field, const TracePlan& plan, BeamPacket& packet, std::span<BeamEnd> ends,
                           TraceCounters& counters) {
    const FloatTag d;
    const WidePoint direction = load_point(packet.direction);
    const Wide s = load_wide(packet.s);
    const WidePoint x = point_at(load_point(packet.origin), direction, s);
    const FloatVec up = hn::Set(d, static_cast<float>(kRoundUp));
    const Wide spread = load_wide(packet.spread);
    const FloatVec radius = hn::Mul(to_float(mul_add(spread, s, load_wide(packet.radius0))), up);
    const FloatVec noise_radius = hn::Load(d, packet.noise_radius);
    const FloatVec speed = hn::Load(d, packet.speed), hint = hn::Load(d, packet.hint);
    const FloatVec least_gain = hn::Mul(radius, hn::Set(d, kLeastGain));

    BeamCache cache;
    const std::uint64_t evaluated = counters.noise_evaluations;
    const FloatVec certain = evaluate_beam<kPlanar>(plan, field, packet, x, direction, radius, cache, counters);
    counters.left_out.too_fine += packet.active_count * plan.octaves.size() - (counters.noise_evaluations - evaluated);
    const BeamPoint at{to_float(direction), base_gradient_at<kPlanar>(field, x), certain};
    BeamSpan span{hint, hn::Mul(hint, speed), radius, hn::Mul(to_float(spread), up)};
    FloatVec slope;
    const FloatVec first = solve_beam<kPlanar, kLoose>(plan, cache, at, span, noise_radius, &slope);
    const FloatVec inverse_lipschitz = hn::Set(d, plan.inverse_lipschitz);
    const FloatVec least = hn::Sub(hn::Mul(certain, inverse_lipschitz), radius);
    span.ahead = hn::Min(hn::Max(hn::Max(first, least_gain), least), hn::Set(d, 1e15f));
    span.along = hn::Mul(span.ahead, speed);
    const FloatVec safe = hn::Max(first, solve_beam<kPlanar, kLoose>(plan, cache, at, span, noise_radius, &slope));
    hn::Store(hn::Min(hn::Max(safe, hn::Max(least_gain, hn::Set(d, 1e-30f))), hn::Set(d, 1e15f)), d, packet.hint);
    move_beams(packet, s, safe, least_gain, slope, certain, ends, counters);
}

template <bool kPlanar, bool kLoose>
HWY_NOINLINE void trace_beams_of(const Field& field, const TracePlan& plan, std::span<const Beam> beams,
                                 std::span<BeamEnd> ends, TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    BeamPacket packet;
    for (std::size_t next = 0;;) {
        for (std::size_t lane = 0; lane < lanes && next < beams.size(); ++lane) {
            while (packet.active[lane] == 0.0f && next < beams.size()) {
                const Beam& beam = beams[next];
                if (beam.start < beam.limit) {
                    take_beam(packet, lane, beam, next, plan.first_hint, field.is_planar_noise());
                } else {
                    ends[next] = {beam.start, beam.hint, 0.0f, true};
                }
                ++next;
            }
        }
        if (packet.active_count == 0) return;
        step_beams<kPlanar, kLoose>(field, plan, packet, ends, counters);
    }
}

template <bool kPlanar>
void trace_beams_over(const Field& field, const TracePlan& plan, std::span<const Beam> beams, std::span<BeamEnd> ends,
                      TraceCounters& counters) {
    if (!field.drifts()) return trace_beams_of<kPlanar, false>(field, plan, beams, ends, counters);
    // Beams of an instant and of a time are not mixed, so that a beam's end is its own.
    const auto has_time = [](const Beam& beam) { return beam.noise_radius > 0.0; };
    const auto middle = std::ranges::find_if_not(beams, has_time);
    if (middle == beams.end()) return trace_beams_of<kPlanar, true>(field, plan, beams, ends, counters);
    if (std::ranges::none_of(beams, has_time))
        return trace_beams_of<kPlanar, false>(field, plan, beams, ends, counters);
    for (std::size_t i = 0; i < beams.size(); ++i)
        trace_beams_over<kPlanar>(field, plan, beams.subspan(i, 1), ends.subspan(i, 1), counters);
}

void TraceBeams(const Field& field, const TracePlan& plan, std::span<const Beam> beams, std::span<BeamEnd> ends,
                TraceCounters& counters) {
    by_dimensions(field, [&](auto planar) HWY_ATTR { trace_beams_over<planar()>(field, plan, beams, ends, counters); });
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(TraceBeams);

void BeamTracer::trace(std::span<const Beam> beams, std::span<BeamEnd> ends, TraceCounters& counters) const {
    if (field_.relief_plan() != nullptr)
        return trace_relief_beams(field_, *field_.relief_plan(), beams, ends, counters);
    HWY_DYNAMIC_DISPATCH(TraceBeams)(field_, field_.plan(), beams, ends, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
