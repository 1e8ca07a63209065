#include "src/trace/fast_tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/fast_tracer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/evaluation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Exchange finished lanes once this fraction of the packet is idle. Speed only.
constexpr std::size_t kIdleFraction = 4;

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

// The longest step that is certified to stay outside the surface.
template <bool kWindows>
HWY_INLINE FloatVec safe_step(const TracePlan& plan, const Packet& packet, const Evaluation& at, FloatVec delta,
                              const OctaveCache& cache) {
    const FloatTag d;
    const FloatVec speed = hn::Load(d, packet.speed), hint = hn::Min(hn::Load(d, packet.hint), at.room);
    const FloatVec certain = hn::Sub(at.f, hn::Add(at.rest, at.error));
    const FloatVec slope = hn::Sub(at.base_slope, hn::Set(d, plan.slope_error));
    const auto solve = [&](const OctaveBounds& bounds, FloatVec step) HWY_ATTR {
        const FloatVec root =
            first_root(hn::Sub(certain, bounds.drop), hn::MulAdd(slope, step, bounds.slope), bounds.bend);
        return hn::Mul(root, step);
    };
    // The global Lipschitz step is where to look again when the hint was so far off that it gave no step.
    const FloatVec first = solve(at.bounds, hint);
    const FloatVec least = hn::Mul(hn::Max(certain, hn::Zero(d)), hn::Set(d, plan.inverse_lipschitz));
    const FloatVec again = hn::Min(hn::Max(hn::Max(first, delta), least), hn::Min(at.room, hn::Set(d, 1e15f)));
    const FloatVec span = hn::Mul(again, speed);
    OctaveBounds bounds = window_bounds<kWindows>(at, again);
    for (std::size_t k = 0; k < cache.count; ++k) {
        const TraceOctave& octave = plan.octaves[k];
        // The span first: a vertical ray's speed of 0 must not meet an infinite product.
        const FloatVec wave = hn::Set(d, octave.wave);
        bounds = add_octave(bounds, plan, octave, cache.value[k], cache.slope[k], hn::Mul(wave, again),
                            hn::Mul(wave, span), uses_octave(at, k));
    }
    return hn::Min(hn::Max(first, solve(bounds, again)), at.room);
}

// Lanes whose stretch of length packet.over behind them is free, by bounds taken backwards. f is at least a concave
// parabola there, so it is positive in between where it is at both ends.
template <bool kWindows>
HWY_INLINE hn::Mask<FloatTag> covers_overstep(const TracePlan& plan, const Packet& packet, const Evaluation& at,
                                              const OctaveCache& cache) {
    const FloatTag d;
    const FloatVec over = hn::Load(d, packet.over), span = hn::Mul(over, hn::Load(d, packet.speed));
    const auto lands = hn::Le(over, hn::Zero(d));
    if (HWY_LIKELY(hn::AllTrue(d, lands))) return lands;
    OctaveBounds bounds = window_bounds<kWindows>(at, over);
    for (std::size_t k = 0; k < cache.count; ++k) {
        const FloatVec wave = hn::Set(d, plan.octaves[k].wave);
        bounds = add_octave(bounds, plan, plan.octaves[k], cache.value[k], hn::Neg(cache.slope[k]), hn::Mul(wave, over),
                            hn::Mul(wave, span), uses_octave(at, k));
    }
    const FloatVec here = hn::Sub(hn::Sub(at.f, hn::Add(at.rest, at.error)), bounds.drop);
    const FloatVec base_slope = hn::Add(at.base_slope, hn::Set(d, plan.slope_error));
    const FloatVec climb = hn::NegMulAdd(base_slope, over, bounds.slope);
    // What is added up here has been rounded a few times.
    const FloatVec size = hn::Add(here, hn::Add(hn::Abs(climb), bounds.bend));
    const FloatVec there = hn::Sub(hn::Add(here, climb), bounds.bend);
    const auto is_free = hn::And(hn::Gt(here, hn::Zero(d)),
                                 hn::Gt(there, hn::Mul(size, hn::Set(d, static_cast<float>(kRoundUp - 1.0)))));
    return hn::Or(lands, is_free);
}

// The root within the last step, by its slope: f <= 0 here, f > 0 at s_outside.
HWY_INLINE double refine(double s, double s_outside, float f, float slope) {
    const double width = s - s_outside;
    const double back = slope < 0.0f ? static_cast<double>(f) / static_cast<double>(slope) : 0.5 * width;
    return s - std::min(std::max(back, 0.0), width);
}

HWY_INLINE void report(const Packet& packet, std::size_t lane, HitState state, float f, float slope, Hit& hit) {
    hit.state = state;
    hit.steps = packet.steps[lane];
    hit.noise_evaluations = packet.evaluations[lane];
    hit.on_bound = state == HitState::hit && packet.enters_bound[lane] && packet.steps[lane] == 1;
    hit.s_outside = packet.s_outside[lane];
    hit.s = state == HitState::hit ? refine(packet.s[lane], hit.s_outside, f, slope) : packet.s[lane];
}

// To where the ray may land, from an overstep that was not covered.
HWY_INLINE void go_back(Packet& packet, std::size_t lane) {
    const double clear = packet.s_outside[lane];
    packet.hint[lane] = packet.over[lane];
    packet.s[lane] -= static_cast<double>(packet.over[lane]);
    packet.s[lane] = std::max(packet.s[lane], clear);
    packet.over[lane] = 0.0f;
    packet.relax[lane] = kRelaxAfterFailure;
}

// What a step found out, a lane each.
struct Outcome {
    alignas(HWY_MAX_BYTES) float f[kMaxLanes];
    alignas(HWY_MAX_BYTES) float slope[kMaxLanes];
    alignas(HWY_MAX_BYTES) float gradient[3][kMaxLanes];
    alignas(HWY_MAX_BYTES) std::uint32_t octaves[kMaxLanes];
    alignas(HWY_MAX_BYTES) float is_hit[kMaxLanes];
    alignas(HWY_MAX_BYTES) float is_covered[kMaxLanes];
    alignas(HWY_MAX_BYTES) float is_unsettled[kMaxLanes];  // a window's error leaves f's sign in doubt
    alignas(HWY_MAX_BYTES) double clear[kMaxLanes];        // up to where the ray is free
    alignas(HWY_MAX_BYTES) double landing[kMaxLanes];      // how far it may go
    alignas(HWY_MAX_BYTES) float over[kMaxLanes];          // how much further it might
};

HWY_INLINE void store_flag(hn::Mask<FloatTag> flag, float* to) {
    const FloatTag d;
    hn::Store(hn::IfThenElseZero(flag, hn::Set(d, 1.0f)), d, to);
}

// Evaluates every active lane's point. The step that it allows is the next hint.
template <SurfaceKind kKind, bool kDrifts, bool kWindows>
HWY_INLINE void find_out(const Field& field, const TracePlan& plan, Packet& packet, Outcome& found,
                         TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const WidePoint direction = load_point(packet.direction);
    const Wide s = load_wide(packet.s);
    const WidePoint x = point_at(load_point(packet.origin), direction, s);
    OctaveCache cache;
    const std::uint64_t evaluated = counters.noise_evaluations;
    Evaluation at = evaluate<kKind, kDrifts, kWindows>(plan, field, packet, x, direction, cache, counters);
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
    auto inside = hn::Or(at.inside, hn::And(at.complete, hn::Le(at.f, hn::Zero(d))));
    if constexpr (kWindows) {
        store_flag(hn::AndNot(hn::Gt(hn::Abs(at.f), at.error), at.windowed), found.is_unsettled);
        inside = hn::Or(inside, hn::And(at.windowed, hn::Lt(at.f, hn::Neg(at.error))));
    }
    store_flag(inside, found.is_hit);
    store_flag(covers_overstep<kWindows>(plan, packet, at, cache), found.is_covered);
    hn::Store(at.f, d, found.f);
    hn::Store(at.slope, d, found.slope);
    hn::Store(at.gradient.x, d, found.gradient[0]);
    hn::Store(at.gradient.y, d, found.gradient[1]);
    hn::Store(at.gradient.z, d, found.gradient[2]);
    hn::Store(at.octaves, dw, found.octaves);
    hn::Store(hn::Min(hn::Max(hn::Max(safe, delta_float), hn::Set(d, 1e-30f)), hn::Set(d, 1e15f)), d, packet.hint);
    // Near the surface there is nothing to be gained.
    const FloatVec further = hn::Mul(hn::Min(safe, hn::Set(d, 1e15f)), hn::Load(d, packet.relax));
    const auto is_far = hn::Gt(further, hn::Mul(delta_float, hn::Set(d, kLeastOverstep)));
    hn::Store(hn::IfThenElseZero(is_far, further), d, found.over);
    const Wide clear = add(s, to_wide(safe));
    store_wide(clear, found.clear);
    store_wide(add(clear, delta), found.landing);
}

// Reports the lane's ray and lets it go.
template <bool kWindows>
HWY_INLINE void end_ray(const TracePlan& plan, Packet& packet, std::size_t lane, HitState state, const Outcome& found,
                        std::span<Hit> hits, TraceCounters& counters) {
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

// To where the ray may land and, it is hoped, further.
template <bool kWindows>
HWY_INLINE void go_on(Packet& packet, std::size_t lane, const Outcome& found) {
    const double landing = found.landing[lane];
    float over = found.over[lane];
    if constexpr (kWindows) {
        over = std::min(over, static_cast<float>(std::max(packet.windows.exit[lane] - landing, 0.0)));
    }
    packet.s_outside[lane] = found.clear[lane];
    packet.relax[lane] = std::min(packet.relax[lane] + kRelaxGain, kMostRelax);
    packet.over[lane] = over;
    packet.s[lane] = landing + static_cast<double>(over);
    if (kWindows && packet.windows.changes(lane, packet.s[lane])) {
        change_window(packet.windows, lane, landing, static_cast<double>(over));
    }
}

// One step of every active lane; lanes that finish report and become idle.
template <SurfaceKind kKind, bool kDrifts, bool kWindows>
HWY_INLINE void step(const Field& field, const TracePlan& plan, Packet& packet, std::span<Hit> hits,
                     TraceCounters& counters) {
    Outcome found;
    find_out<kKind, kDrifts, kWindows>(field, plan, packet, found, counters);
    for (std::size_t lane = 0; lane < hn::Lanes(FloatTag()); ++lane) {
        if (packet.ray[lane] == kNoRay) continue;
        const bool is_covered = found.is_covered[lane] != 0.0f;
        if (kWindows && is_covered && found.is_unsettled[lane] != 0.0f) {
            packet.windows.leave(lane);  // and looks again: not a step
            continue;
        }
        ++packet.steps[lane];
        ++counters.steps;
        const bool is_last = packet.steps[lane] >= packet.step_limit[lane];
        if (!is_covered && !is_last) {
            go_back(packet, lane);
            continue;
        }
        const bool is_hit = is_covered && found.is_hit[lane] != 0.0f;
        const bool is_miss = is_covered && !is_hit && found.landing[lane] >= packet.end[lane];
        if (is_hit || is_miss || is_last) {
            const HitState state = is_hit ? HitState::hit : is_miss ? HitState::miss : HitState::unresolved;
            end_ray<kWindows>(plan, packet, lane, state, found, hits, counters);
        } else {
            go_on<kWindows>(packet, lane, found);
        }
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

template <SurfaceKind kKind, bool kDrifts, bool kWindows>
HWY_NOINLINE void trace_moving(const Field& field, const TracePlan& plan, std::span<const Ray> rays,
                               std::span<Hit> hits, TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    Packet packet;
    std::fill_n(packet.ray, lanes, kNoRay);
    for (std::size_t next = 0;;) {
        if (next < rays.size() && packet.active_count + lanes / kIdleFraction <= lanes) {
            refill(field, plan, rays, hits, next, packet);
        }
        if (packet.active_count == 0) return;
        step<kKind, kDrifts, kWindows>(field, plan, packet, hits, counters);
    }
}

template <SurfaceKind kKind, bool kWindows>
void trace_windowed(const Field& field, const TracePlan& plan, std::span<const Ray> rays, std::span<Hit> hits,
                    TraceCounters& counters) {
    if (field.drifts()) return trace_moving<kKind, true, kWindows>(field, plan, rays, hits, counters);
    trace_moving<kKind, false, kWindows>(field, plan, rays, hits, counters);
}

template <SurfaceKind kKind>
void trace_kind(const Field& field, const TracePlan& plan, std::span<const Ray> rays, std::span<Hit> hits,
                TraceCounters& counters) {
    const bool has_windows = std::ranges::any_of(rays, [](const Ray& ray) { return ray.window != nullptr; });
    if (has_windows) return trace_windowed<kKind, true>(field, plan, rays, hits, counters);
    trace_windowed<kKind, false>(field, plan, rays, hits, counters);
}

void Trace(const Field& field, const TracePlan& plan, std::span<const Ray> rays, std::span<Hit> hits,
           TraceCounters& counters) {
    switch (field.kind()) {
        case SurfaceKind::terrain:
            return trace_kind<SurfaceKind::terrain>(field, plan, rays, hits, counters);
        case SurfaceKind::hyperterrain:
            return trace_kind<SurfaceKind::hyperterrain>(field, plan, rays, hits, counters);
        case SurfaceKind::planet:
            return trace_kind<SurfaceKind::planet>(field, plan, rays, hits, counters);
        case SurfaceKind::isosurface:
            return trace_kind<SurfaceKind::isosurface>(field, plan, rays, hits, counters);
    }
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(Trace);

void FastTracer::trace(std::span<const Ray> rays, std::span<Hit> hits, TraceCounters& counters) const {
    HWY_DYNAMIC_DISPATCH(Trace)(field_, plan_, rays, hits, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
