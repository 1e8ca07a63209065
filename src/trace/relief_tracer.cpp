// Rays through composed reliefs: at each point the relief's enclosure in a ball of the hinted step's size gives a
// quadratic below f, whose first root is a safe step. Octaves too fine for the ball are left out, so the ball is halved
// where the sign is in doubt; where all octaves leave it in doubt the reference path decides in double.
#include <algorithm>

#include "src/trace/relief_tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/relief_tracer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/lane_bits-inl.h"
#include "src/trace/lower_bound-inl.h"
#include "src/trace/packet-inl.h"
#include "src/trace/relief_enclosure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// What the next ball is to the step that was taken: where its bounds ended the step, and where the ball itself did; and
// to a ball that left the sign in doubt. Speed only: of factors from 0.65 to 2.5 these took the fewest evaluations.
constexpr float kAgain = 0.75f, kGrow = 1.2f, kShrink = 0.35f;

// Rounding of base minus relief, both floats that have been rounded before.
constexpr float kDifference = 0x1p-22f;

struct ReliefStep {
    FloatVec f, slope;  // of what was evaluated, along the ray
    FloatVec safe;
    hn::Mask<FloatTag> is_hit, is_doubtful;
    hn::Mask<FloatTag> is_lost;  // f is not a number even in double
};

// The reference path's value where all octaves were evaluated and float cannot tell the sign.
HWY_INLINE void settle_relief(const Field& field, Packet& packet, const WidePoint& x, hn::Mask<FloatTag> doubtful,
                              FloatVec& f, TraceCounters& counters) {
    const FloatTag d;
    alignas(HWY_MAX_BYTES) double point[3][kMaxLanes];
    alignas(HWY_MAX_BYTES) float values[kMaxLanes];
    store_wide(x.x, point[0]);
    store_wide(x.y, point[1]);
    store_wide(x.z, point[2]);
    hn::Store(f, d, values);
    for (const std::size_t lane : LaneSet(doubtful)) {
        const auto& shift = packet.noise_shift;
        values[lane] = static_cast<float>(field.value({point[0][lane], point[1][lane], point[2][lane]},
                                                      {shift[0][lane], shift[1][lane], shift[2][lane]}));
        const std::size_t octaves = field.evaluations();
        packet.evaluations[lane] += static_cast<std::uint32_t>(octaves);
        counters.noise_evaluations += octaves;
        counters.executed_lanes += octaves;
    }
    f = hn::Load(d, values);
}

template <bool kPlanar>
HWY_INLINE ReliefStep relief_step(const Field& field, const TracePlan& constants, const ReliefPlan& plan,
                                  Packet& packet, FloatVec delta, TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const FloatVec zero = hn::Zero(d);
    const WidePoint direction = load_point(packet.direction);
    const WidePoint x = point_at(load_point(packet.origin), direction, load_wide(packet.s));
    WidePoint noise_x = x;
    if (field.drifts()) noise_x = add(x, load_point(packet.noise_shift));
    const FloatVec hint = hn::Load(d, packet.hint), speed = hn::Load(d, packet.speed);
    FloatVec evaluations = zero;
    auto broken = hn::Lt(zero, zero);
    const auto active = hn::Gt(hn::Load(d, packet.active), zero);
    const auto whole = hn::Le(hint, delta);
    const ReliefPoints points{hn::Mul(hint, speed), active, whole, &counters, &evaluations, &broken};
    const Enclosure r = enclose<kPlanar>(plan, noise_x, packet.reach, points);
    hn::Store(hn::Add(hn::Load(dw, packet.evaluations),
                      hn::BitCast(dw, hn::ConvertTo(hn::RebindToSigned<FloatTag>(), evaluations))),
              dw, packet.evaluations);

    const Base base = base_at<kPlanar>(field, x, direction);
    ReliefStep step;
    step.f = hn::Sub(base.value, r.value);
    const FloatVec error = hn::Mul(set(kDifference), hn::Add(hn::Abs(base.value), hn::Abs(r.value)));
    FloatVec lower = hn::Sub(step.f, hn::Add(error, r.up.e0));
    const auto inside = hn::Lt(hn::Add(step.f, hn::Add(error, r.down.e0)), zero);
    // What is not a number is neither above 0 nor below.
    auto unsure = hn::AndNot(hn::Or(inside, hn::Gt(lower, zero)), active);
    step.is_hit = hn::And(active, inside);
    const auto settled = hn::And(unsure, whole);
    step.is_lost = hn::Lt(zero, zero);
    FloatVec least = zero;
    if (!hn::AllFalse(d, settled)) {
        settle_relief(field, packet, x, settled, step.f, counters);
        // What is known of the point says nothing of those about it, but for what the global Lipschitz constant does:
        // without it a ray whose tolerance begins at 0 would stay for ever at a start that float cannot tell from a
        // hit.
        lower = hn::IfThenZeroElse(settled, lower);
        const FloatVec slowest = set(constants.inverse_lipschitz * static_cast<float>(kRoundDown));
        least = hn::IfThenElseZero(settled, hn::Mul(hn::Max(step.f, zero), slowest));
        step.is_hit = hn::Or(step.is_hit, hn::And(settled, hn::Le(step.f, zero)));
        step.is_lost = hn::And(settled, hn::IsNaN(step.f));
        unsure = hn::AndNot(whole, unsure);
    }
    step.is_doubtful = unsure;
    const FloatPoint axis = to_float(direction);
    const FloatVec climb = dot(r.gradient, axis);
    step.slope = hn::Sub(base.slope, climb);
    // The direction's rounding turns the gradient's part by 2^-23 of its length.
    const FloatVec turned = hn::Mul(set(kDifference), hn::Add(set(1.0f), length(r.gradient)));
    const FloatVec rate = hn::Sub(step.slope, hn::MulAdd(r.up.e1, speed, turned));
    const FloatVec bend = hn::Mul(r.up.e2, hn::Mul(speed, speed));
    step.safe = hn::Max(hn::Min(first_root(lower, rate, bend), hint), least);
    return step;
}

HWY_INLINE void end_relief_ray(Packet& packet, std::size_t lane, HitState state, float f, float slope,
                               std::span<Hit> hits) {
    Hit& hit = hits[packet.ray[lane]];
    report(packet, lane, state, f, slope, hit);
    // A ball that was too large is a step too, and leads nowhere.
    const bool has_moved = packet.s[lane] != packet.s_outside[lane];
    hit.on_bound = state == HitState::hit && packet.enters_bound[lane] && !has_moved;
    drop_lane(packet, lane);
}

template <bool kPlanar>
HWY_INLINE void step_relief(const Field& field, const TracePlan& constants, const ReliefPlan& plan, Packet& packet,
                            std::span<Hit> hits, TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const auto active = hn::Gt(hn::Load(d, packet.active), hn::Zero(d));
    const Wide s = load_wide(packet.s);
    const Wide delta = mul_add(load_wide(packet.delta_slope), s, load_wide(packet.delta0));
    const FloatVec delta_float = to_float(delta), hint = hn::Load(d, packet.hint);
    const ReliefStep found = relief_step<kPlanar>(field, constants, plan, packet, delta_float, counters);
    const WordVec taken =
        hn::Add(hn::Load(dw, packet.steps), hn::IfThenElseZero(hn::RebindMask(dw, active), hn::Set(dw, 1u)));
    hn::Store(taken, dw, packet.steps);
    counters.steps += hn::CountTrue(d, active);
    const WordVec limit = hn::Load(dw, packet.step_limit);
    const auto is_last = hn::RebindMask(d, hn::Eq(hn::Max(taken, limit), taken));

    const auto moves = hn::AndNot(hn::Or(found.is_hit, hn::Or(found.is_doubtful, found.is_lost)), active);
    const Wide clear = add(s, to_wide(found.safe)), landing = add(clear, delta);
    const auto misses = hn::And(moves, narrow(greater_equal(landing, load_wide(packet.end))));
    const auto ends = hn::Or(hn::Or(found.is_hit, misses), hn::Or(found.is_lost, hn::And(active, is_last)));
    const auto goes_on = hn::AndNot(ends, moves);
    store_wide(select(widen(goes_on), clear, load_wide(packet.s_outside)), packet.s_outside);
    store_wide(select(widen(goes_on), landing, s), packet.s);
    const FloatVec growth = hn::IfThenElse(hn::Lt(found.safe, hint), set(kAgain), set(kGrow));
    const FloatVec next = hn::IfThenElse(found.is_doubtful, hn::Mul(hint, set(kShrink)),
                                         hn::Mul(hn::Add(found.safe, delta_float), growth));
    hn::Store(hn::Min(hn::Max(next, delta_float), set(1e15f)), d, packet.hint);
    if (hn::AllFalse(d, ends)) return;
    alignas(HWY_MAX_BYTES) float f[kMaxLanes], slope[kMaxLanes];
    hn::Store(found.f, d, f);
    hn::Store(found.slope, d, slope);
    const LaneSet hits_of(found.is_hit), misses_of(misses);
    for (const std::size_t lane : LaneSet(ends)) {
        const HitState state = hits_of.contains(lane)     ? HitState::hit
                               : misses_of.contains(lane) ? HitState::miss
                                                          : HitState::unresolved;
        end_relief_ray(packet, lane, state, f[lane], slope[lane], hits);
    }
}

template <bool kPlanar>
HWY_NOINLINE void trace_relief_rays(const Field& field, const TracePlan& constants, const ReliefPlan& plan,
                                    std::span<const Ray> rays, std::span<Hit> hits, TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    Packet packet;
    std::fill_n(packet.ray, lanes, kNoRay);
    for (std::size_t next = 0;;) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            while (packet.ray[lane] == kNoRay && next < rays.size()) {
                const Ray& ray = rays[next];
                const Interval inside = field.clip(ray.origin, ray.direction, ray.limit);
                hits[next] = Hit{};
                if (std::max(inside.begin, ray.start) < inside.end) {
                    take_ray(packet, lane, ray, next, inside, constants, kPlanar);
                    packet.windows.leave(lane);
                }
                ++next;
            }
        }
        if (packet.active_count == 0) return;
        step_relief<kPlanar>(field, constants, plan, packet, hits, counters);
    }
}

void TraceRelief(const Field& field, const TracePlan& constants, const ReliefPlan& plan, std::span<const Ray> rays,
                 std::span<Hit> hits, TraceCounters& counters) {
    by_dimensions(field, [&](auto planar)
                             HWY_ATTR { trace_relief_rays<planar()>(field, constants, plan, rays, hits, counters); });
}

// Gradients of f at points, all octaves of the relief evaluated.
template <bool kPlanar>
HWY_NOINLINE void relief_gradients(const Field& field, const ReliefPlan& plan, std::span<const glm::dvec3> x,
                                   std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient,
                                   TraceCounters& counters) {
    const FloatTag d;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t begin = 0; begin < x.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, x.size() - begin);
        alignas(HWY_MAX_BYTES) double at[3][kMaxLanes] = {};
        alignas(HWY_MAX_BYTES) float out[3][kMaxLanes], used[kMaxLanes] = {};
        double reach = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 p = noise_shift.empty() ? x[begin + i] : x[begin + i] + noise_shift[begin + i];
            used[i] = 1.0f;
            for (int a = 0; a < 3; ++a) {
                at[a][i] = p[a];
                reach = std::max(reach, std::abs(p[a]));
            }
        }
        FloatVec evaluations = hn::Zero(d);
        auto broken = hn::Lt(evaluations, evaluations);
        const auto active = hn::Gt(hn::Load(d, used), hn::Zero(d));
        const ReliefPoints points{hn::Zero(d), active, active, &counters, &evaluations, &broken};
        const Enclosure r = enclose<kPlanar>(plan, load_point(at), reach, points);
        hn::Store(r.gradient.x, d, out[0]);
        hn::Store(r.gradient.y, d, out[1]);
        hn::Store(r.gradient.z, d, out[2]);
        for (std::size_t i = 0; i < count; ++i) {
            gradient[begin + i] =
                glm::vec3(field.base_gradient(x[begin + i])) - glm::vec3(out[0][i], out[1][i], out[2][i]);
        }
    }
}

void ReliefGradients(const Field& field, const ReliefPlan& plan, std::span<const glm::dvec3> x,
                     std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient, TraceCounters& counters) {
    by_dimensions(field, [&](auto planar)
                             HWY_ATTR { relief_gradients<planar()>(field, plan, x, noise_shift, gradient, counters); });
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(TraceRelief);
HWY_EXPORT(ReliefGradients);

void trace_relief(const Field& field, const TracePlan& constants, const ReliefPlan& plan, std::span<const Ray> rays,
                  std::span<Hit> hits, TraceCounters& counters) {
    HWY_DYNAMIC_DISPATCH(TraceRelief)(field, constants, plan, rays, hits, counters);
}

void relief_gradients(const Field& field, const ReliefPlan& plan, std::span<const glm::dvec3> x,
                      std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient, TraceCounters& counters) {
    HWY_DYNAMIC_DISPATCH(ReliefGradients)(field, plan, x, noise_shift, gradient, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
