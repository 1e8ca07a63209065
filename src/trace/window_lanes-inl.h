// The window that each lane of a packet is in. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_WINDOW_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_WINDOW_LANES_INL_H_
#undef STRATA_TRACE_WINDOW_LANES_INL_H_
#else
#define STRATA_TRACE_WINDOW_LANES_INL_H_
#endif

#include <algorithm>
#include <cassert>
#include <limits>

#include "src/trace/base-inl.h"
#include "src/trace/lane_bits-inl.h"
#include "src/trace/ray.h"
#include "src/trace/window.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Lanes without a window read as one of all zeros, with an exit at infinity.
struct WindowLanes {
    alignas(HWY_MAX_BYTES) double centre[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double exit[kMaxLanes];  // the ray is in the ball up to here
    alignas(HWY_MAX_BYTES) float value[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float gradient[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float hessian[6][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float error[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double change[kMaxLanes] = {};  // where to look for the next one
    const Window* next[kMaxLanes] = {};                    // the first that the ray may enter yet

    static constexpr double kNever = std::numeric_limits<double>::infinity();

    WindowLanes() { std::fill_n(exit, kMaxLanes, kNever); }

    bool holds(std::size_t lane) const { return error[lane] > 0.0f; }

    void leave(std::size_t lane) {
        if (!holds(lane)) return;
        exit[lane] = kNever;
        change[lane] = next[lane] == nullptr ? kNever : 0.0;
        value[lane] = error[lane] = 0.0f;
        for (auto& axis : gradient) axis[lane] = 0.0f;
        for (auto& entry : hessian) entry[lane] = 0.0f;
    }

    void enter(std::size_t lane, const Window& window) {
        assert(window.error > 0.0f);
        for (int a = 0; a < 3; ++a) {
            centre[a][lane] = window.centre[a];
            gradient[a][lane] = window.gradient[a];
        }
        for (std::size_t i = 0; i < window.hessian.size(); ++i) hessian[i][lane] = window.hessian[i];
        exit[lane] = change[lane] = window.to;
        value[lane] = window.value;
        error[lane] = window.error;
        next[lane] = window.after();
    }
};

// Takes the lane out of its window and into the next one that holds its ray from s to s + over, if there is one.
HWY_INLINE void change_window(WindowLanes& lanes, std::size_t lane, double s, double over) {
    lanes.leave(lane);
    const Window* window = lanes.next[lane];
    while (window != nullptr && s + over >= window->to) window = window->after();
    lanes.next[lane] = window;
    if (window != nullptr && s >= window->from) return lanes.enter(lane, *window);
    lanes.change[lane] = window == nullptr ? WindowLanes::kNever : window->from;
}

// Of the rays among `lanes` that are at `ahead`, from a safe landing `over` before, those that leave their windows or
// reach the next.
HWY_INLINE void change_windows(WindowLanes& windows, hn::Mask<FloatTag> lanes, const Wide& ahead, const Wide& landing,
                               FloatVec over) {
    const LaneSet changes(hn::And(lanes, narrow(greater_equal(ahead, load_wide(windows.change)))));
    if (changes.begin() == changes.end()) return;
    alignas(HWY_MAX_BYTES) double landings[kMaxLanes];
    alignas(HWY_MAX_BYTES) float overs[kMaxLanes];
    store_wide(landing, landings);
    hn::Store(over, FloatTag(), overs);
    for (const std::size_t lane : changes) {
        change_window(windows, lane, landings[lane], static_cast<double>(overs[lane]));
    }
}

// What the windows say of the noise at x in its domain.
struct WindowPart {
    FloatVec value, slope, bend;  // along the ray; slope and half the second derivative, per unit length
    FloatVec error;
};

HWY_INLINE WindowPart window_part(const WindowLanes& lanes, const WidePoint& x, const FloatPoint& direction) {
    const FloatTag d;
    const FloatPoint off = {to_float(sub(x.x, load_wide(lanes.centre[0]))),
                            to_float(sub(x.y, load_wide(lanes.centre[1]))),
                            to_float(sub(x.z, load_wide(lanes.centre[2])))};
    const auto load = [&](const float* from) HWY_ATTR { return hn::Load(d, from); };
    const FloatVec xx = load(lanes.hessian[0]), yy = load(lanes.hessian[1]), zz = load(lanes.hessian[2]);
    const FloatVec xy = load(lanes.hessian[3]), xz = load(lanes.hessian[4]), yz = load(lanes.hessian[5]);
    const auto times = [&](const FloatPoint& v) HWY_ATTR {
        return FloatPoint{dot({xx, xy, xz}, v), dot({xy, yy, yz}, v), dot({xz, yz, zz}, v)};
    };
    const FloatVec half = hn::Set(d, 0.5f);
    const FloatPoint turn = times(off),
                     gradient = {load(lanes.gradient[0]), load(lanes.gradient[1]), load(lanes.gradient[2])};
    const FloatPoint middle = {hn::MulAdd(half, turn.x, gradient.x), hn::MulAdd(half, turn.y, gradient.y),
                               hn::MulAdd(half, turn.z, gradient.z)};
    const FloatPoint here = {hn::Add(gradient.x, turn.x), hn::Add(gradient.y, turn.y), hn::Add(gradient.z, turn.z)};
    return {hn::Add(load(lanes.value), dot(middle, off)), dot(here, direction),
            hn::Mul(half, dot(times(direction), direction)), load(lanes.error)};
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
