// The state of one packet of rays, a lane each, in memory: finished lanes are exchanged for new rays one at a time.
// Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_PACKET_INL_H_
#undef STRATA_TRACE_PACKET_INL_H_
#else
#define STRATA_TRACE_PACKET_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "src/trace/octave-inl.h"
#include "src/trace/ray.h"
#include "src/trace/window_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

inline constexpr std::size_t kNoRay = std::numeric_limits<std::size_t>::max();

// How far a ray's first safe step is overstepped, as a fraction of it. Speed only.
inline constexpr float kFirstRelax = 0.5f;

struct Packet {
    alignas(HWY_MAX_BYTES) double origin[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double direction[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double noise_shift[3][kMaxLanes] = {};  // of drifting noise
    alignas(HWY_MAX_BYTES) double s[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double s_outside[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double end[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double delta0[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double delta_slope[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float speed[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float hint[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float over[kMaxLanes] = {};    // s lies so much further than a landing may
    alignas(HWY_MAX_BYTES) float relax[kMaxLanes] = {};   // how far to overstep next, in safe steps
    alignas(HWY_MAX_BYTES) float active[kMaxLanes] = {};  // 1 or 0
    alignas(HWY_MAX_BYTES) std::uint32_t evaluations[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) std::uint32_t steps[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) std::uint32_t step_limit[kMaxLanes] = {};
    std::size_t ray[kMaxLanes] = {};
    bool enters_bound[kMaxLanes] = {};
    WindowLanes windows;
    double reach = 0.0;  // bound of |x + noise_shift| on every axis over all rays taken so far
    std::size_t active_count = 0;
};

// Over a height field's 2-D noise only the horizontal part of the ray moves.
HWY_INLINE float domain_speed(bool is_planar, const glm::dvec3& direction) {
    if (!is_planar) return 1.0f;
    return static_cast<float>(std::sqrt(direction.x * direction.x + direction.z * direction.z) * kRoundUp);
}

HWY_INLINE void take_ray(Packet& packet, std::size_t lane, const Ray& ray, std::size_t index, const Interval& inside,
                         const TracePlan& plan, bool is_planar) {
    for (int a = 0; a < 3; ++a) {
        packet.origin[a][lane] = ray.origin[a];
        packet.direction[a][lane] = ray.direction[a];
        packet.noise_shift[a][lane] = ray.noise_shift[a];
        packet.reach = std::max(packet.reach, std::abs(ray.origin[a] + ray.noise_shift[a]) + inside.end);
    }
    packet.s[lane] = packet.s_outside[lane] = std::max(inside.begin, ray.start);
    packet.end[lane] = inside.end;
    packet.delta0[lane] = ray.delta0;
    packet.delta_slope[lane] = ray.delta_slope;
    packet.speed[lane] = domain_speed(is_planar, ray.direction);
    packet.hint[lane] = ray.hint > 0.0f ? ray.hint : plan.first_hint;
    packet.over[lane] = 0.0f;
    packet.relax[lane] = kFirstRelax;
    packet.active[lane] = 1.0f;
    packet.evaluations[lane] = 0;
    packet.steps[lane] = 0;
    packet.step_limit[lane] = ray.step_limit;
    packet.ray[lane] = index;
    packet.enters_bound[lane] = inside.enters_bound && inside.begin >= ray.start;
    packet.windows.next[lane] = ray.window;
    change_window(packet.windows, lane, packet.s[lane], 0.0);
    ++packet.active_count;
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

HWY_INLINE void drop_lane(Packet& packet, std::size_t lane) {
    packet.active[lane] = 0.0f;
    packet.ray[lane] = kNoRay;
    packet.windows.leave(lane);
    --packet.active_count;
}

HWY_INLINE WidePoint load_point(const double (&from)[3][kMaxLanes]) {
    return {load_wide(from[0]), load_wide(from[1]), load_wide(from[2])};
}

HWY_INLINE WidePoint add(const WidePoint& a, const WidePoint& b) {
    return {add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)};
}

HWY_INLINE WidePoint point_at(const WidePoint& origin, const WidePoint& direction, const Wide& s) {
    return {mul_add(s, direction.x, origin.x), mul_add(s, direction.y, origin.y), mul_add(s, direction.z, origin.z)};
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
