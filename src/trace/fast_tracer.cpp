#include "src/trace/fast_tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/fast_tracer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/base-inl.h"
#include "src/trace/lower_bound-inl.h"
#include "src/trace/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// An octave is evaluated where the hinted step is below this many of its lattice cells: beyond, its amplitude bound is
// the least anyway. Speed only; measured minimum of evaluations a ray, flat from 0.2 to 0.4.
constexpr float kCellsAhead = 0.3f;

// Exchange finished lanes once this fraction of the packet is idle. Speed only.
constexpr std::size_t kIdleFraction = 4;

// Oversteps, in safe steps: what each success adds, the most, and where to begin anew after a failure; none shorter
// than some tolerances. Speed only.
constexpr float kRelaxGain = 0.2f, kMostRelax = 0.9f, kRelaxAfterFailure = 0.0f, kLeastOverstep = 2.0f;

// |f| below this many error bounds is settled in double.
constexpr float kDoubtful = 4.0f;

// What one step learns of every lane.
struct Evaluation {
    FloatVec f;      // base minus the evaluated octaves
    FloatVec error;  // of f
    FloatVec slope;  // of f along the ray; of use where all octaves were evaluated
    FloatVec base_slope;
    FloatPoint gradient;  // of the evaluated octaves, of f's sign
    FloatVec rest;        // bound of the octaves not evaluated
    OctaveBounds bounds;
    hn::Mask<FloatTag> complete;  // all octaves were evaluated
    hn::Mask<FloatTag> inside;    // f < 0 whatever the octaves not evaluated
    WordVec octaves;              // how many were
};

struct OctaveCache {
    std::array<FloatVec, noise::kMaxOctaves> value, slope;
    std::size_t count = 0;
};

// x is where the ray is; the noise is evaluated elsewhere when it drifts.
template <SurfaceKind kKind, bool kDrifts>
HWY_INLINE Evaluation evaluate(const TracePlan& plan, const Field& field, const Packet& packet, const WidePoint& x,
                               const WidePoint& direction, OctaveCache& cache, TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const FloatVec hint = hn::Load(d, packet.hint), span = hn::Mul(hint, hn::Load(d, packet.speed));
    const FloatVec dx = to_float(direction.x), dy = to_float(direction.y), dz = to_float(direction.z);
    const Base base = base_at<kKind>(field, x, direction);
    WidePoint noise_x = x;
    if constexpr (kDrifts) noise_x = add(x, load_point(packet.noise_shift));
    Evaluation at{base.value,  hn::Zero(d), base.slope, base.slope, base_gradient_at<kKind>(x),
                  hn::Zero(d), no_bounds(), {},         {},         hn::Zero(dw)};
    at.error = hn::MulAdd(hn::Abs(base.value), hn::Set(d, plan.error_relative), hn::Set(d, plan.error_absolute));
    auto open = hn::Gt(hn::Load(d, packet.active), hn::Zero(d));
    at.inside = hn::Lt(hn::Zero(d), hn::Zero(d));
    cache.count = 0;
    for (const TraceOctave& octave : plan.octaves) {
        // Stop where f is negative whatever the rest, or positive and the octave is too fine for the step to gain by
        // it.
        const FloatVec rest = hn::Set(d, octave.rest), wave = hn::Set(d, octave.wave);
        const FloatVec ws = hn::Mul(wave, span);
        const auto doubtful = hn::Le(hn::Sub(at.f, rest), at.error);
        const auto certain = hn::And(open, hn::Lt(hn::Add(at.f, rest), hn::Neg(at.error)));
        const auto wanted = hn::AndNot(certain, hn::And(open, hn::Or(doubtful, hn::Le(ws, hn::Set(d, kCellsAhead)))));
        at.inside = hn::Or(at.inside, certain);
        at.rest = hn::IfThenElse(hn::AndNot(wanted, open), rest, at.rest);
        open = wanted;
        if (hn::AllFalse(d, open)) break;
        const OctaveSample n = sample_octave<kIsPlanar<kKind>>(octave, noise_x, packet.reach);
        FloatVec slope = hn::MulAdd(n.dx, dx, hn::Mul(n.dz, dz));
        if constexpr (!kIsPlanar<kKind>) slope = hn::MulAdd(n.dy, dy, slope);
        const FloatVec amplitude = hn::IfThenElseZero(open, hn::Set(d, octave.amplitude));
        at.f = hn::NegMulAdd(amplitude, n.value, at.f);
        const FloatVec pull = hn::Mul(amplitude, wave);
        at.slope = hn::NegMulAdd(pull, slope, at.slope);
        at.gradient.x = hn::NegMulAdd(pull, n.dx, at.gradient.x);
        if constexpr (!kIsPlanar<kKind>) at.gradient.y = hn::NegMulAdd(pull, n.dy, at.gradient.y);
        at.gradient.z = hn::NegMulAdd(pull, n.dz, at.gradient.z);
        at.bounds = add_octave(at.bounds, plan, octave, n.value, slope, hn::Mul(wave, hint), ws, open);
        at.octaves = hn::Add(at.octaves, hn::IfThenElseZero(hn::RebindMask(dw, open), hn::Set(dw, 1u)));
        cache.value[cache.count] = n.value;
        cache.slope[cache.count++] = slope;
        counters.noise_evaluations += hn::CountTrue(d, open);
        counters.executed_lanes += hn::Lanes(d);
    }
    at.complete = open;
    return at;
}

// Replaces f where float cannot tell its sign by the reference path's value in double.
HWY_INLINE void settle_doubt(const Field& field, const TracePlan& plan, Packet& packet, const WidePoint& x,
                             Evaluation& at, TraceCounters& counters) {
    const FloatTag d;
    const auto doubtful = hn::And(at.complete, hn::Le(hn::Abs(at.f), hn::Mul(at.error, hn::Set(d, kDoubtful))));
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

HWY_INLINE hn::Mask<FloatTag> uses_octave(const Evaluation& at, std::size_t k) {
    const hn::RebindToSigned<FloatTag> d;
    return hn::RebindMask(FloatTag(), hn::Gt(hn::BitCast(d, at.octaves), hn::Set(d, static_cast<int>(k))));
}

// The longest step that is certified to stay outside the surface.
HWY_INLINE FloatVec safe_step(const TracePlan& plan, const Packet& packet, const Evaluation& at, FloatVec delta,
                              const OctaveCache& cache) {
    const FloatTag d;
    const FloatVec speed = hn::Load(d, packet.speed), hint = hn::Load(d, packet.hint);
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
    const FloatVec again = hn::Min(hn::Max(hn::Max(first, delta), least), hn::Set(d, 1e15f));
    const FloatVec span = hn::Mul(again, speed);
    OctaveBounds bounds = no_bounds();
    for (std::size_t k = 0; k < cache.count; ++k) {
        const TraceOctave& octave = plan.octaves[k];
        // The span first: a vertical ray's speed of 0 must not meet an infinite product.
        const FloatVec wave = hn::Set(d, octave.wave);
        bounds = add_octave(bounds, plan, octave, cache.value[k], cache.slope[k], hn::Mul(wave, again),
                            hn::Mul(wave, span), uses_octave(at, k));
    }
    return hn::Max(first, solve(bounds, again));
}

// Lanes whose stretch of length packet.over behind them is free, by bounds taken backwards. f is at least a concave
// parabola there, so it is positive in between where it is at both ends.
HWY_INLINE hn::Mask<FloatTag> covers_overstep(const TracePlan& plan, const Packet& packet, const Evaluation& at,
                                              const OctaveCache& cache) {
    const FloatTag d;
    const FloatVec over = hn::Load(d, packet.over), span = hn::Mul(over, hn::Load(d, packet.speed));
    const auto lands = hn::Le(over, hn::Zero(d));
    if (HWY_LIKELY(hn::AllTrue(d, lands))) return lands;
    OctaveBounds bounds = no_bounds();
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

// One step of every active lane; lanes that finish report and become idle.
template <SurfaceKind kKind, bool kDrifts>
HWY_INLINE void step(const Field& field, const TracePlan& plan, Packet& packet, std::span<Hit> hits,
                     TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const WidePoint direction = load_point(packet.direction);
    const Wide s = load_wide(packet.s);
    const WidePoint x = point_at(load_point(packet.origin), direction, s);
    OctaveCache cache;
    Evaluation at = evaluate<kKind, kDrifts>(plan, field, packet, x, direction, cache, counters);
    hn::Store(hn::Add(hn::Load(dw, packet.evaluations), at.octaves), dw, packet.evaluations);
    settle_doubt(field, plan, packet, x, at, counters);

    const Wide delta = mul_add(load_wide(packet.delta_slope), s, load_wide(packet.delta0));
    const FloatVec delta_float = to_float(delta);
    const FloatVec safe = safe_step(plan, packet, at, delta_float, cache);
    const auto covered = covers_overstep(plan, packet, at, cache);
    const auto inside = hn::Or(at.inside, hn::And(at.complete, hn::Le(at.f, hn::Zero(d))));

    alignas(HWY_MAX_BYTES) float f[kMaxLanes], slope[kMaxLanes], hit[kMaxLanes], gradient[3][kMaxLanes],
        is_covered[kMaxLanes], over[kMaxLanes];
    alignas(HWY_MAX_BYTES) std::uint32_t octaves[kMaxLanes];
    alignas(HWY_MAX_BYTES) double outside[kMaxLanes], landing[kMaxLanes];
    hn::Store(at.f, d, f);
    hn::Store(at.slope, d, slope);
    hn::Store(at.gradient.x, d, gradient[0]);
    hn::Store(at.gradient.y, d, gradient[1]);
    hn::Store(at.gradient.z, d, gradient[2]);
    hn::Store(at.octaves, dw, octaves);
    hn::Store(hn::IfThenElseZero(inside, hn::Set(d, 1.0f)), d, hit);
    hn::Store(hn::Min(hn::Max(hn::Max(safe, delta_float), hn::Set(d, 1e-30f)), hn::Set(d, 1e15f)), d, packet.hint);
    hn::Store(hn::IfThenElseZero(covered, hn::Set(d, 1.0f)), d, is_covered);
    // Near the surface there is nothing to be gained.
    const FloatVec further = hn::Mul(hn::Min(safe, hn::Set(d, 1e15f)), hn::Load(d, packet.relax));
    hn::Store(hn::IfThenElseZero(hn::Gt(further, hn::Mul(delta_float, hn::Set(d, kLeastOverstep))), further), d, over);
    const Wide clear = add(s, to_wide(safe));
    store_wide(clear, outside);
    store_wide(add(clear, delta), landing);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
        if (packet.ray[lane] == kNoRay) continue;
        ++packet.steps[lane];
        ++counters.steps;
        if (is_covered[lane] == 0.0f && packet.steps[lane] < packet.step_limit[lane]) {
            go_back(packet, lane);
            continue;
        }
        const bool is_hit = hit[lane] != 0.0f;
        const bool is_miss = !is_hit && landing[lane] >= packet.end[lane];
        if (is_hit || is_miss || packet.steps[lane] >= packet.step_limit[lane]) {
            const HitState state = is_hit ? HitState::hit : is_miss ? HitState::miss : HitState::unresolved;
            Hit& found = hits[packet.ray[lane]];
            report(packet, lane, state, f[lane], slope[lane], found);
            found.gradient = {gradient[0][lane], gradient[1][lane], gradient[2][lane]};
            // The normal of a bound owes nothing to the noise.
            found.octaves = found.on_bound ? static_cast<std::uint32_t>(plan.octaves.size()) : octaves[lane];
            drop_lane(packet, lane);
            continue;
        }
        packet.s_outside[lane] = outside[lane];
        packet.relax[lane] = std::min(packet.relax[lane] + kRelaxGain, kMostRelax);
        packet.over[lane] = over[lane];
        packet.s[lane] = landing[lane] + static_cast<double>(packet.over[lane]);
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

template <SurfaceKind kKind, bool kDrifts>
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
        step<kKind, kDrifts>(field, plan, packet, hits, counters);
    }
}

template <SurfaceKind kKind>
void trace_kind(const Field& field, const TracePlan& plan, std::span<const Ray> rays, std::span<Hit> hits,
                TraceCounters& counters) {
    if (field.drifts()) return trace_moving<kKind, true>(field, plan, rays, hits, counters);
    trace_moving<kKind, false>(field, plan, rays, hits, counters);
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
