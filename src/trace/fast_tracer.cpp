#include "src/trace/fast_tracer.h"

#include "src/trace/relief_tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/fast_tracer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/lane_bits-inl.h"
#include "src/trace/safe_step-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Exchange finished lanes once this fraction of the packet is idle. Speed only.
constexpr std::size_t kIdleFraction = 8;

// Oversteps, in safe steps: what each success adds, the most, and where to begin anew after a failure; none shorter
// than some tolerances. Speed only.
constexpr float kRelaxGain = 0.2f, kMostRelax = 0.9f, kRelaxAfterFailure = 0.0f, kLeastOverstep = 2.0f;

// Replaces f where float cannot tell its sign by the reference path's value in double.
HWY_INLINE void settle_doubt(const Field& field, const TracePlan& plan, Packet& packet, const WidePoint& x,
                             Evaluation& at, TraceCounters& counters) {
    const FloatTag d;
    const auto doubtful = hn::And(at.complete, hn::Le(hn::Abs(at.f), at.error));
    if (HWY_LIKELY(hn::AllFalse(d, doubtful))) return;
    alignas(HWY_MAX_BYTES) double point[3][kMaxLanes];
    alignas(HWY_MAX_BYTES) float f[kMaxLanes], error[kMaxLanes], flag[kMaxLanes];
    store_wide(x.x, point[0]);
    store_wide(x.y, point[1]);
    store_wide(x.z, point[2]);
    hn::Store(at.f, d, f);
    hn::Store(at.error, d, error);
    hn::Store(hn::IfThenElseZero(doubtful, hn::Set(d, 1.0f)), d, flag);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
        if (flag[lane] == 0.0f) continue;
        const auto& shift = packet.noise_shift;
        f[lane] = static_cast<float>(field.value({point[0][lane], point[1][lane], point[2][lane]},
                                                 {shift[0][lane], shift[1][lane], shift[2][lane]}));
        error[lane] = std::abs(f[lane]) * plan.error_relative;
        const std::size_t octaves = field.octaves().size();
        packet.evaluations[lane] += static_cast<std::uint32_t>(octaves);
        counters.noise_evaluations += octaves;
        counters.executed_lanes += octaves;
    }
    at.f = hn::Load(d, f);
    at.error = hn::Load(d, error);
}

// What a step found out of every lane.
struct Outcome {
    FloatVec f, slope;
    FloatPoint gradient;
    WordVec octaves;
    hn::Mask<FloatTag> is_hit, is_covered;
    hn::Mask<FloatTag> is_unsettled;  // a window's error leaves f's sign in doubt
    Wide clear;                       // up to where the ray is free
    Wide landing;                     // how far it may go
    FloatVec over;                    // how much further it might
};

// Evaluates every active lane's point. The step that it allows is the next hint.
template <bool kPlanar, bool kWindows>
HWY_INLINE Outcome find_out(const Field& field, const TracePlan& plan, Packet& packet, TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const WidePoint direction = load_point(packet.direction);
    const Wide s = load_wide(packet.s);
    const WidePoint x = point_at(load_point(packet.origin), direction, s);
    OctaveCache cache;
    const std::uint64_t evaluated = counters.noise_evaluations;
    Evaluation at = evaluate<kPlanar, kWindows>(plan, field, packet, x, direction, cache, counters);
    // Without those that end_ray moves to `settled`.
    counters.left_out.too_fine += packet.active_count * plan.octaves.size() - (counters.noise_evaluations - evaluated);
    if constexpr (kWindows) {
        const std::size_t in_window = hn::CountTrue(d, at.windowed) * plan.octaves.size();
        counters.left_out.in_window += in_window;
        counters.left_out.too_fine -= in_window;
    }
    hn::Store(hn::Add(hn::Load(dw, packet.evaluations), at.octaves), dw, packet.evaluations);
    settle_doubt(field, plan, packet, x, at, counters);

    const Wide delta = mul_add(load_wide(packet.delta_slope), s, load_wide(packet.delta0));
    const FloatVec delta_float = to_float(delta);
    const FloatVec safe = safe_step<kWindows>(plan, packet, at, delta_float, cache);
    Outcome found;
    found.is_hit = hn::Or(at.inside, hn::And(at.complete, hn::Le(at.f, hn::Zero(d))));
    if constexpr (kWindows) {
        found.is_unsettled = hn::AndNot(hn::Gt(hn::Abs(at.f), at.error), at.windowed);
        found.is_hit = hn::Or(found.is_hit, hn::And(at.windowed, hn::Lt(at.f, hn::Neg(at.error))));
    }
    found.is_covered = covers_overstep<kWindows>(plan, packet, at, cache);
    found.f = at.f;
    found.slope = at.slope;
    found.gradient = at.gradient;
    found.octaves = at.octaves;
    hn::Store(hn::Min(hn::Max(hn::Max(safe, delta_float), hn::Set(d, 1e-30f)), hn::Set(d, 1e15f)), d, packet.hint);
    // Near the surface there is nothing to be gained.
    const FloatVec further = hn::Mul(hn::Min(safe, hn::Set(d, 1e15f)), hn::Load(d, packet.relax));
    const auto is_far = hn::Gt(further, hn::Mul(delta_float, hn::Set(d, kLeastOverstep)));
    found.over = hn::IfThenElseZero(is_far, further);
    found.clear = add(s, to_wide(safe));
    found.landing = add(found.clear, delta);
    return found;
}

// What of an Outcome is read lane by lane.
struct StoredOutcome {
    explicit StoredOutcome(const Outcome& found) {
        const FloatTag d;
        hn::Store(found.f, d, f);
        hn::Store(found.slope, d, slope);
        hn::Store(found.gradient.x, d, gradient[0]);
        hn::Store(found.gradient.y, d, gradient[1]);
        hn::Store(found.gradient.z, d, gradient[2]);
        hn::Store(found.octaves, WordTag(), octaves);
    }

    alignas(HWY_MAX_BYTES) float f[kMaxLanes];
    alignas(HWY_MAX_BYTES) float slope[kMaxLanes];
    alignas(HWY_MAX_BYTES) float gradient[3][kMaxLanes];
    alignas(HWY_MAX_BYTES) std::uint32_t octaves[kMaxLanes];
};

// Reports the lane's ray and lets it go.
template <bool kWindows>
HWY_INLINE void end_ray(const TracePlan& plan, Packet& packet, std::size_t lane, HitState state,
                        const StoredOutcome& found, std::span<Hit> hits, TraceCounters& counters) {
    Hit& hit = hits[packet.ray[lane]];
    report(packet, lane, state, found.f[lane], found.slope[lane], hit);
    hit.gradient = {found.gradient[0][lane], found.gradient[1][lane], found.gradient[2][lane]};
    hit.octaves = found.octaves[lane];  // in a window none
    const bool in_window = kWindows && packet.windows.holds(lane);
    if (state == HitState::hit && !in_window) {
        counters.left_out.settled += plan.octaves.size() - hit.octaves;
        counters.left_out.too_fine -= plan.octaves.size() - hit.octaves;
    }
    // The normal of a bound owes nothing to the noise.
    if (hit.on_bound) hit.octaves = static_cast<std::uint32_t>(plan.octaves.size());
    drop_lane(packet, lane);
}

// To where the rays may land, from oversteps that were not covered.
HWY_INLINE void go_back(Packet& packet, hn::Mask<FloatTag> lanes) {
    const FloatTag d;
    const FloatVec over = hn::Load(d, packet.over);
    const Wide s = load_wide(packet.s);
    const Wide landing = max(sub(s, to_wide(over)), load_wide(packet.s_outside));
    store_lanes(lanes, over, packet.hint);
    store_lanes(lanes, hn::Zero(d), packet.over);
    store_lanes(lanes, hn::Set(d, kRelaxAfterFailure), packet.relax);
    store_wide(select(widen(lanes), landing, s), packet.s);
}

// To where the rays may land and, it is hoped, further.
template <bool kWindows>
HWY_INLINE void go_on(Packet& packet, hn::Mask<FloatTag> lanes, const Outcome& found) {
    const FloatTag d;
    const FloatVec relax = hn::Min(hn::Add(hn::Load(d, packet.relax), hn::Set(d, kRelaxGain)), hn::Set(d, kMostRelax));
    FloatVec over = found.over;
    if constexpr (kWindows) {
        const FloatVec room = to_float(sub(load_wide(packet.windows.exit), found.landing));
        over = hn::Min(over, hn::Max(room, hn::Zero(d)));
    }
    const Wide ahead = add(found.landing, to_wide(over));
    const WideMask wide_lanes = widen(lanes);
    store_lanes(lanes, relax, packet.relax);
    store_lanes(lanes, over, packet.over);
    store_wide(select(wide_lanes, found.clear, load_wide(packet.s_outside)), packet.s_outside);
    store_wide(select(wide_lanes, ahead, load_wide(packet.s)), packet.s);
    if constexpr (kWindows) change_windows(packet.windows, lanes, ahead, found.landing, over);
}

// One step of every active lane; lanes that finish report and become idle.
template <bool kPlanar, bool kWindows>
HWY_INLINE void step(const Field& field, const TracePlan& plan, Packet& packet, std::span<Hit> hits,
                     TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const Outcome found = find_out<kPlanar, kWindows>(field, plan, packet, counters);
    auto steps = hn::Gt(hn::Load(d, packet.active), hn::Zero(d));
    if constexpr (kWindows) {
        const auto unsettled = hn::And(steps, hn::And(found.is_covered, found.is_unsettled));
        steps = hn::AndNot(unsettled, steps);  // those leave their window and look again: not a step
        for (const std::size_t lane : LaneSet(unsettled)) packet.windows.leave(lane);
    }
    const WordVec taken =
        hn::Add(hn::Load(dw, packet.steps), hn::IfThenElseZero(hn::RebindMask(dw, steps), hn::Set(dw, 1u)));
    hn::Store(taken, dw, packet.steps);
    counters.steps += hn::CountTrue(d, steps);
    const WordVec limit = hn::Load(dw, packet.step_limit);
    const auto is_last = hn::RebindMask(d, hn::Eq(hn::Max(taken, limit), taken));
    const auto covered = hn::And(steps, found.is_covered);
    const auto hit = hn::And(covered, found.is_hit);
    const auto past_end = narrow(greater_equal(found.landing, load_wide(packet.end)));
    const auto miss = hn::AndNot(hit, hn::And(covered, past_end));
    const auto ends = hn::Or(hn::Or(hit, miss), hn::And(steps, is_last));
    go_back(packet, hn::AndNot(ends, hn::AndNot(covered, steps)));
    go_on<kWindows>(packet, hn::AndNot(ends, covered), found);
    if (hn::AllFalse(d, ends)) return;
    const StoredOutcome stored(found);
    const LaneSet hits_of(hit), misses(miss);
    for (const std::size_t lane : LaneSet(ends)) {
        const HitState state = hits_of.contains(lane)  ? HitState::hit
                               : misses.contains(lane) ? HitState::miss
                                                       : HitState::unresolved;
        end_ray<kWindows>(plan, packet, lane, state, stored, hits, counters);
    }
}

// The next ray that enters the field's slab, shell or bound; others miss at once.
HWY_INLINE void refill(const Field& field, const TracePlan& plan, std::span<const Ray> rays, std::span<Hit> hits,
                       std::size_t& next, Packet& packet) {
    for (std::size_t lane = 0; lane < hn::Lanes(FloatTag()); ++lane) {
        while (packet.ray[lane] == kNoRay && next < rays.size()) {
            const Ray& ray = rays[next];
            const Interval inside = field.clip(ray.origin, ray.direction, ray.limit);
            hits[next] = Hit{};
            if (std::max(inside.begin, ray.start) < inside.end)
                take_ray(packet, lane, ray, next, inside, plan, field.is_planar_noise());
            ++next;
        }
    }
}

template <bool kPlanar, bool kWindows>
HWY_NOINLINE void trace_rays(const Field& field, const TracePlan& plan, std::span<const Ray> rays, std::span<Hit> hits,
                             TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    Packet packet;
    std::fill_n(packet.ray, lanes, kNoRay);
    for (std::size_t next = 0;;) {
        if (next < rays.size() && packet.active_count + std::max<std::size_t>(1, lanes / kIdleFraction) <= lanes) {
            refill(field, plan, rays, hits, next, packet);
        }
        if (packet.active_count == 0) return;
        step<kPlanar, kWindows>(field, plan, packet, hits, counters);
    }
}

template <bool kPlanar>
void trace_over(const Field& field, const TracePlan& plan, std::span<const Ray> rays, std::span<Hit> hits,
                TraceCounters& counters) {
    const bool has_windows = std::ranges::any_of(rays, [](const Ray& ray) { return ray.window != nullptr; });
    if (has_windows) return trace_rays<kPlanar, true>(field, plan, rays, hits, counters);
    trace_rays<kPlanar, false>(field, plan, rays, hits, counters);
}

void Trace(const Field& field, const TracePlan& plan, std::span<const Ray> rays, std::span<Hit> hits,
           TraceCounters& counters) {
    by_dimensions(field, [&](auto planar) HWY_ATTR { trace_over<planar()>(field, plan, rays, hits, counters); });
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(Trace);

void FastTracer::trace(std::span<const Ray> rays, std::span<Hit> hits, TraceCounters& counters) const {
    if (field_.relief_plan() != nullptr)
        return trace_relief(field_, field_.plan(), *field_.relief_plan(), rays, hits, counters);
    HWY_DYNAMIC_DISPATCH(Trace)(field_, field_.plan(), rays, hits, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
