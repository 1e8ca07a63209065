#include "src/trace/bracket.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/bracket.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/base-inl.h"
#include "src/trace/first_fall-inl.h"
#include "src/trace/lane_bits-inl.h"
#include "src/trace/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Sums of bounds, rounded a few times.
constexpr float kSumUp = 1.0f + 0x1p-19f;

// Parabolas whose coefficients are larger might overflow.
constexpr float kLargestFall = 1e18f;

// Rays of one cell, a lane each.
struct RayBlock {
    alignas(HWY_MAX_BYTES) double origin[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double direction[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double noise_shift[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double free[kMaxLanes] = {};  // f > 0 up to here
    alignas(HWY_MAX_BYTES) double end[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double inside[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double guess[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float open[kMaxLanes] = {};   // 1 or 0: to be looked at in the next window
    alignas(HWY_MAX_BYTES) float doubt[kMaxLanes] = {};  // 1 or 0: f may have fallen to 0 behind `free`
    BracketState state[kMaxLanes] = {};
};

// A ray that enters the isosurface's bound may hit the bound itself: it stays open.
HWY_INLINE void take_ray(RayBlock& block, std::size_t lane, const Field& field, const Ray& ray) {
    const Interval inside = field.clip(ray.origin, ray.direction, ray.limit);
    for (int a = 0; a < 3; ++a) {
        block.origin[a][lane] = ray.origin[a];
        block.direction[a][lane] = ray.direction[a];
        block.noise_shift[a][lane] = ray.noise_shift[a];
    }
    block.free[lane] = std::max(inside.begin, ray.start);
    block.end[lane] = inside.end;
    const bool misses = !(block.free[lane] < inside.end);
    const bool may_meet_bound = inside.enters_bound && inside.begin >= ray.start;
    block.state[lane] = misses ? BracketState::miss : BracketState::open;
    block.open[lane] = misses || may_meet_bound ? 0.0f : 1.0f;
    block.doubt[lane] = 0.0f;
}

// Of the noise along a vector of rays in one window: value, slope and half the second derivative.
struct WindowParabola {
    FloatVec value, slope, bend;
};

HWY_INLINE WindowParabola window_parabola(const Window& window, const WidePoint& x, const FloatPoint& direction) {
    const FloatTag d;
    const auto off_axis = [&](const Wide& at, int axis) HWY_ATTR {
        const DoubleVec centre = hn::Set(DoubleTag(), window.centre[axis]);
        return to_float(each_part([&](auto v) HWY_ATTR { return hn::Sub(v, centre); }, at));
    };
    const FloatPoint off = {off_axis(x.x, 0), off_axis(x.y, 1), off_axis(x.z, 2)};
    const auto& h = window.hessian;
    const FloatVec xx = hn::Set(d, h[0]), yy = hn::Set(d, h[1]), zz = hn::Set(d, h[2]);
    const FloatVec xy = hn::Set(d, h[3]), xz = hn::Set(d, h[4]), yz = hn::Set(d, h[5]);
    const auto times = [&](const FloatPoint& v) HWY_ATTR {
        return FloatPoint{dot({xx, xy, xz}, v), dot({xy, yy, yz}, v), dot({xz, yz, zz}, v)};
    };
    const FloatVec half = hn::Set(d, 0.5f);
    const FloatPoint turn = times(off), gradient = {hn::Set(d, window.gradient.x), hn::Set(d, window.gradient.y),
                                                    hn::Set(d, window.gradient.z)};
    const FloatPoint middle = {hn::MulAdd(half, turn.x, gradient.x), hn::MulAdd(half, turn.y, gradient.y),
                               hn::MulAdd(half, turn.z, gradient.z)};
    const FloatPoint here = {hn::Add(gradient.x, turn.x), hn::Add(gradient.y, turn.y), hn::Add(gradient.z, turn.z)};
    return {hn::Add(hn::Set(d, window.value), dot(middle, off)), dot(here, direction),
            hn::Mul(half, dot(times(direction), direction))};
}

// In a window the rays' stretches [begin, begin + length), and on them x = 0 to 1 of c0 + c1 x + c2 x^2 for f. That is
// off by `error` at most; upward, the base may bend by `lift` more.
struct Stretch {
    Wide begin, end, length;
    FloatVec c0, c1, c2, error, lift;
    hn::Mask<FloatTag> is_sound;  // there is a stretch, and it can be computed with
};

// With u = 2^-24, the coefficients' own roundings are: of c1 that of the slope (counted in plan.slope_error), of the
// length and of the product, of c2 twice the length's and two of products. 4 u (|c1| + |c2|) is added for them.
template <bool kPlanar>
HWY_INLINE Stretch stretch_of(const Field& field, const TracePlan& plan, const RayBlock& block, const Window& window,
                              float half_curvature) {
    const FloatTag d;
    const DoubleTag dd;
    Stretch result;
    const DoubleVec from = hn::Set(dd, window.from), to = hn::Set(dd, window.to);
    result.begin = each_part([&](auto s) HWY_ATTR { return hn::Max(s, from); }, load_wide(block.free));
    result.end = each_part([&](auto s) HWY_ATTR { return hn::Min(s, to); }, load_wide(block.end));
    result.length = sub(result.end, result.begin);
    const WidePoint direction = load_point(block.direction);
    const WidePoint x = point_at(load_point(block.origin), direction, result.begin);
    WidePoint noise_x = x;
    if (field.drifts()) noise_x = add(x, load_point(block.noise_shift));
    const Base base = base_at<kPlanar>(field, x, direction);
    const WindowParabola noise = window_parabola(window, noise_x, to_float(direction));
    const FloatVec length = to_float(result.length);
    result.c0 = hn::Sub(base.value, noise.value);
    result.c1 = hn::Mul(hn::Sub(base.slope, noise.slope), length);
    result.c2 = hn::Neg(hn::Mul(hn::Mul(noise.bend, length), length));
    FloatVec error = hn::Set(d, window.error + plan.error_absolute);
    error = hn::MulAdd(hn::Abs(base.value), hn::Set(d, plan.error_relative), error);
    error = hn::MulAdd(length, hn::Set(d, plan.slope_error), error);
    const FloatVec size = fall_size(result.c0, result.c1, result.c2);
    result.error = hn::MulAdd(size, hn::Set(d, kFallPad + 4 * 0x1p-24f), hn::Mul(error, hn::Set(d, kSumUp)));
    result.lift = hn::Mul(hn::Mul(length, length), hn::Set(d, half_curvature));
    result.is_sound =
        hn::And(hn::Gt(length, hn::Zero(d)), hn::Lt(hn::Add(size, result.error), hn::Set(d, kLargestFall)));
    return result;
}

HWY_INLINE Wide along(const Stretch& stretch, FloatVec x) { return mul_add(to_wide(x), stretch.length, stretch.begin); }

// What the window says of every open ray.
template <bool kPlanar>
HWY_INLINE void look_in_window(const Field& field, const TracePlan& plan, RayBlock& block, const Window& window,
                               float half_curvature) {
    const FloatTag d;
    const FloatVec zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const Stretch on = stretch_of<kPlanar>(field, plan, block, window, half_curvature);
    // A window that begins behind what is free, or ends before, says nothing.
    auto open = hn::And(hn::Gt(hn::Load(d, block.open), zero), on.is_sound);
    const auto was_in_doubt = hn::Gt(hn::Load(d, block.doubt), zero);
    const auto is_gap = hn::AndNot(was_in_doubt, hn::Not(narrow(greater_equal(load_wide(block.free), on.begin))));
    open = hn::AndNot(is_gap, open);
    if (hn::AllFalse(d, open)) return;

    const FloatVec low0 = hn::Sub(on.c0, on.error), high0 = hn::Add(on.c0, on.error), high2 = hn::Add(on.c2, on.lift);
    const FloatVec low = hn::Min(fall_no_later(low0, on.c1, on.c2), one);
    const FloatVec high = fall_no_sooner(high0, on.c1, high2);
    const FloatVec root = hn::Min(first_fall(hn::Max(on.c0, zero), on.c1, on.c2), hn::Min(high, one));

    // Clear again after a doubt: the ray passed close by, or through less than a window can tell.
    const auto recovers = hn::And(hn::And(open, was_in_doubt), hn::Gt(low0, zero));
    open = hn::AndNot(recovers, open);
    const auto falls = hn::And(open, hn::Or(was_in_doubt, hn::Lt(low, one)));
    const auto lands = hn::And(falls, hn::Le(high, one));
    const auto begins_doubt = hn::AndNot(was_in_doubt, falls);
    const auto passes = hn::AndNot(falls, open);
    const Wide free = select(widen(begins_doubt), along(on, low), load_wide(block.free));
    store_wide(select(widen(passes), on.end, free), block.free);
    store_lanes(falls, one, block.doubt);
    const WideMask wide_lands = widen(lands);
    store_wide(select(wide_lands, along(on, high), load_wide(block.inside)), block.inside);
    store_wide(select(wide_lands, along(on, root), load_wide(block.guess)), block.guess);
    const auto misses = hn::And(passes, narrow(greater_equal(on.end, load_wide(block.end))));
    store_lanes(hn::Or(hn::Or(recovers, lands), misses), zero, block.open);
    for (const std::size_t lane : LaneSet(lands)) block.state[lane] = BracketState::bracket;
    for (const std::size_t lane : LaneSet(misses)) block.state[lane] = BracketState::miss;
}

template <bool kPlanar>
void bracket_rays(const Field& field, const TracePlan& plan, std::span<const Ray> rays, const WindowedRays& group,
                  float half_curvature, std::span<Bracket> brackets) {
    const FloatTag d;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t begin = group.first; begin < group.last; begin += lanes) {
        const std::size_t count = std::min(lanes, group.last - begin);
        RayBlock block;
        for (std::size_t lane = 0; lane < count; ++lane) take_ray(block, lane, field, rays[begin + lane]);
        for (const Window* window = group.window; window != nullptr; window = window->after()) {
            if (hn::AllFalse(d, hn::Gt(hn::Load(d, block.open), hn::Zero(d)))) break;
            // Too little for float to tell its roots.
            if (window->error < kLeastFall) continue;
            look_in_window<kPlanar>(field, plan, block, *window, half_curvature);
        }
        for (std::size_t lane = 0; lane < count; ++lane) {
            const double guess =
                std::clamp(block.guess[lane], block.free[lane], std::max(block.free[lane], block.inside[lane]));
            brackets[begin + lane] = {block.state[lane], block.free[lane], block.inside[lane], guess};
        }
    }
}

void BracketRays(const Field& field, const TracePlan& plan, std::span<const Ray> rays, const WindowedRays& group,
                 float half_curvature, std::span<Bracket> brackets) {
    by_dimensions(field, [&](auto planar)
                             HWY_ATTR { bracket_rays<planar()>(field, plan, rays, group, half_curvature, brackets); });
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(BracketRays);

double Bracketer::half_curvature(const Field& field) {
    return solid::visit([&](const auto& s) { return s.half_curvature(field.amplitude()); }, field.solid()) * kRoundUp;
}

void Bracketer::bracket(std::span<const Ray> rays, const WindowedRays& group, std::span<Bracket> brackets) const {
    HWY_DYNAMIC_DISPATCH(BracketRays)
    (field_, field_.plan(), rays, group, static_cast<float>(half_curvature_), brackets);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
