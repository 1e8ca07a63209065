#include "src/trace/landing.h"

#include <algorithm>
#include <cmath>

#include "noise/bounds.h"
#include "noise/float_error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/landing.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/base-inl.h"
#include "src/trace/first_fall-inl.h"
#include "src/trace/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// How often a bracket is narrowed by one evaluation. Speed only.
constexpr int kNarrowings = 3;

// A bracket that came out longer than this part of what it was is halved next. Speed only.
constexpr float kShrinks = 0.6f;

// Rays to be landed, a lane each.
struct LandingBlock {
    alignas(HWY_MAX_BYTES) double origin[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double direction[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double noise_shift[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) double s[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float outside[kMaxLanes] = {};  // from s on
    alignas(HWY_MAX_BYTES) float inside[kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float delta[kMaxLanes] = {};
    double reach = 0.0;  // bound of |x + noise_shift| on every axis
};

HWY_INLINE void take_bracket(LandingBlock& block, std::size_t lane, const Ray& ray, const Bracket& bracket) {
    for (int a = 0; a < 3; ++a) {
        block.origin[a][lane] = ray.origin[a];
        block.direction[a][lane] = ray.direction[a];
        block.noise_shift[a][lane] = ray.noise_shift[a];
        block.reach = std::max(block.reach, std::abs(ray.origin[a] + ray.noise_shift[a]) + bracket.inside);
    }
    block.s[lane] = bracket.guess;
    block.outside[lane] = static_cast<float>(bracket.outside - bracket.guess);
    block.inside[lane] = static_cast<float>(bracket.inside - bracket.guess);
    block.delta[lane] = static_cast<float>((ray.delta0 + ray.delta_slope * bracket.outside) * kRoundDown);
}

// f at the lanes' points, its gradient, and half its second derivative along the rays.
struct Landed {
    FloatVec f, error, slope, bend;
    FloatPoint gradient;
    FloatVec base;  // of f, that in front of the noise
};

template <bool kNear>
HWY_INLINE void add_octave3(const TraceOctave& octave, const WidePoint& x, const FloatPoint& along, Landed& at) {
    const AxisSample px = locate<kNear>(octave, 0, x.x), py = locate<kNear>(octave, 1, x.y);
    const AxisSample pz = locate<kNear>(octave, 2, x.z);
    const simd_noise::Jet3 n =
        simd_noise::noise3(px.planes, py.planes, pz.planes, px.fraction, py.fraction, pz.fraction);
    const FloatVec amplitude = hn::Set(FloatTag(), octave.amplitude);
    const FloatVec wave = hn::Set(FloatTag(), static_cast<float>(octave.frequency));
    const FloatVec pull = hn::Mul(amplitude, wave), bend = hn::Mul(pull, wave);
    const FloatPoint turn = {dot({n.dxx, n.dxy, n.dxz}, along), dot({n.dxy, n.dyy, n.dyz}, along),
                             dot({n.dxz, n.dyz, n.dzz}, along)};
    at.f = hn::NegMulAdd(amplitude, n.value, at.f);
    at.gradient = {hn::NegMulAdd(pull, n.dx, at.gradient.x), hn::NegMulAdd(pull, n.dy, at.gradient.y),
                   hn::NegMulAdd(pull, n.dz, at.gradient.z)};
    at.slope = hn::NegMulAdd(pull, dot({n.dx, n.dy, n.dz}, along), at.slope);
    at.bend = hn::NegMulAdd(bend, dot(turn, along), at.bend);
}

template <bool kNear>
HWY_INLINE void add_octave2(const TraceOctave& octave, const WidePoint& x, const FloatPoint& along, Landed& at) {
    const AxisSample px = locate<kNear>(octave, 0, x.x), pz = locate<kNear>(octave, 1, x.z);
    const simd_noise::Jet2 n = simd_noise::noise2(px.planes, pz.planes, px.fraction, pz.fraction);
    const FloatVec amplitude = hn::Set(FloatTag(), octave.amplitude);
    const FloatVec wave = hn::Set(FloatTag(), static_cast<float>(octave.frequency));
    const FloatVec pull = hn::Mul(amplitude, wave), bend = hn::Mul(pull, wave);
    const FloatVec turn_x = hn::MulAdd(n.dxx, along.x, hn::Mul(n.dxy, along.z));
    const FloatVec turn_z = hn::MulAdd(n.dxy, along.x, hn::Mul(n.dyy, along.z));
    at.f = hn::NegMulAdd(amplitude, n.value, at.f);
    at.gradient.x = hn::NegMulAdd(pull, n.dx, at.gradient.x);
    at.gradient.z = hn::NegMulAdd(pull, n.dy, at.gradient.z);
    at.slope = hn::NegMulAdd(pull, hn::MulAdd(n.dx, along.x, hn::Mul(n.dy, along.z)), at.slope);
    at.bend = hn::NegMulAdd(bend, hn::MulAdd(turn_x, along.x, hn::Mul(turn_z, along.z)), at.bend);
}

template <bool kPlanar, bool kNear>
HWY_INLINE void add_octave_at(const TraceOctave& octave, const WidePoint& x, const FloatPoint& along, Landed& at) {
    if constexpr (kPlanar) {
        add_octave2<kNear>(octave, x, along, at);
    } else {
        add_octave3<kNear>(octave, x, along, at);
    }
}

template <bool kPlanar>
HWY_INLINE Landed evaluate_landing(const Field& field, const LandingPlan& plan, const LandingBlock& block) {
    const FloatTag d;
    const WidePoint direction = load_point(block.direction);
    const WidePoint x = point_at(load_point(block.origin), direction, load_wide(block.s));
    WidePoint noise_x = x;
    if (field.drifts()) noise_x = add(x, load_point(block.noise_shift));
    const FloatPoint along = to_float(direction);
    const Base base = base_at<kPlanar>(field, x, direction);
    Landed at{base.value, hn::Zero(d), base.slope, hn::Zero(d), base_gradient_at<kPlanar>(field, x), base.value};
    for (const TraceOctave& octave : plan.trace.octaves) {
        if (HWY_LIKELY(octave.frequency * block.reach + 2.0 < kNearCells)) {
            add_octave_at<kPlanar, true>(octave, noise_x, along, at);
        } else {
            add_octave_at<kPlanar, false>(octave, noise_x, along, at);
        }
    }
    at.bend = hn::Mul(at.bend, hn::Set(d, 0.5f));
    at.error =
        hn::MulAdd(hn::Abs(base.value), hn::Set(d, plan.trace.error_relative), hn::Set(d, plan.trace.error_absolute));
    return at;
}

// A bracket about the point of evaluation.
struct Narrowed {
    FloatVec outside, inside;
};

// About f + f' y + b y^2 for y in [outside, inside], |y| <= r: on x = 0 to 1 it is c0 + c1 x + c2 x^2 with
//   c0 = f + o (f' + o b),  c1 = w (f' + 2 o b),  c2 = w^2 b,   o = outside, w = inside - outside <= 2 r.
// Each has up to four roundings, of terms that sum up to |f| + 5 |f'| r + 13 |b| r^2: 2^-22 of that sum. first_fall's
// own error, kFallPad (|c0| + |c1| + |c2|), is 2^-23 of it at most. 2^-17 (|f| + |f'| r + |b| r^2), of which 13 * 3/8
// would do, is more than both. What f itself may be off by is at least kLeastFall, as first_fall wants it.
HWY_INLINE Narrowed narrow_bracket(const LandingPlan& plan, const Landed& at, const Narrowed& was) {
    const FloatTag d;
    const FloatVec one = hn::Set(d, 1.0f);
    const FloatVec r = hn::Mul(hn::Max(hn::Abs(was.outside), hn::Abs(was.inside)), hn::Set(d, 1.0f + 0x1p-20f));
    const FloatVec cubic = hn::MulAdd(r, hn::Set(d, plan.cube), hn::Set(d, plan.bend_error));
    const FloatVec linear = hn::MulAdd(r, cubic, hn::Set(d, plan.trace.slope_error));
    const FloatVec size = hn::MulAdd(r, hn::MulAdd(r, hn::Abs(at.bend), hn::Abs(at.slope)), hn::Abs(at.f));
    const FloatVec error = hn::MulAdd(
        size, hn::Set(d, 0x1p-17f),
        hn::Mul(hn::MulAdd(r, linear, hn::Max(at.error, hn::Set(d, kLeastFall))), hn::Set(d, 1.0f + 0x1p-19f)));
    const FloatVec width = hn::Sub(was.inside, was.outside);
    const FloatVec c0 = hn::MulAdd(was.outside, hn::MulAdd(was.outside, at.bend, at.slope), at.f);
    const FloatVec c1 = hn::Mul(width, hn::MulAdd(hn::Add(was.outside, was.outside), at.bend, at.slope));
    const FloatVec c2 = hn::Mul(hn::Mul(width, width), at.bend);
    // Upwards the base may bend by half_curvature y^2 <= half_curvature r^2 more, if it is nowhere deeper than that
    // holds for.
    const auto is_deep = hn::Lt(hn::Sub(at.base, r), hn::Set(d, plan.deepest));
    const FloatVec above = hn::MulAdd(hn::Mul(r, r), hn::Set(d, plan.half_curvature), error);
    const FloatVec low = hn::Min(fall_no_later(hn::Sub(c0, error), c1, c2), one);
    const FloatVec high = hn::IfThenElse(is_deep, one, hn::Min(fall_no_sooner(hn::Add(c0, above), c1, c2), one));
    // Places are rounded by less than 2^-22 r.
    const FloatVec place = hn::Mul(r, hn::Set(d, 0x1p-22f));
    const FloatVec outside = hn::Max(was.outside, hn::Sub(hn::MulAdd(low, width, was.outside), place));
    const FloatVec inside = hn::Min(was.inside, hn::Add(hn::MulAdd(high, width, was.outside), place));
    return {outside, inside};
}

// The root of the parabola within the bracket, about.
HWY_INLINE FloatVec root_in(const Landed& at, const Narrowed& bracket) {
    const FloatVec o = bracket.outside;
    const FloatVec slope = hn::MulAdd(hn::Add(o, o), at.bend, at.slope);
    const FloatVec root = first_fall(hn::MulAdd(o, hn::MulAdd(o, at.bend, at.slope), at.f), slope, at.bend);
    return hn::Min(hn::Add(o, root), bracket.inside);
}

// What was found of every lane, to be read lane by lane.
struct LandingResult {
    alignas(HWY_MAX_BYTES) float outside[kMaxLanes], inside[kMaxLanes], root[kMaxLanes], gradient[3][kMaxLanes];
    alignas(HWY_MAX_BYTES) float found[kMaxLanes];  // 1 or 0
};

template <bool kPlanar>
HWY_INLINE LandingResult land_block(const Field& field, const LandingPlan& plan, const LandingBlock& block) {
    const FloatTag d;
    const Landed at = evaluate_landing<kPlanar>(field, plan, block);
    // From double to float they were rounded.
    const FloatVec outside = hn::Load(d, block.outside), inside = hn::Load(d, block.inside);
    const FloatVec place = hn::Set(d, 0x1p-22f);
    const Narrowed was = {hn::NegMulAdd(hn::Abs(outside), place, outside), hn::MulAdd(hn::Abs(inside), place, inside)};
    Narrowed now = was;
    for (int i = 0; i < kNarrowings; ++i) now = narrow_bracket(plan, at, now);
    const FloatVec width = hn::Sub(now.inside, now.outside), delta = hn::Load(d, block.delta);
    const FloatVec root = root_in(at, now);
    const auto found = hn::And(hn::Le(width, delta), hn::Le(hn::Abs(root), delta));
    const auto shrinks = hn::Lt(width, hn::Mul(hn::Sub(was.inside, was.outside), hn::Set(d, kShrinks)));
    const FloatVec middle = hn::MulAdd(width, hn::Set(d, 0.5f), now.outside);
    LandingResult result;
    hn::Store(now.outside, d, result.outside);
    hn::Store(now.inside, d, result.inside);
    hn::Store(hn::IfThenElse(hn::Or(found, shrinks), root, middle), d, result.root);
    hn::Store(at.gradient.x, d, result.gradient[0]);
    hn::Store(at.gradient.y, d, result.gradient[1]);
    hn::Store(at.gradient.z, d, result.gradient[2]);
    hn::Store(hn::IfThenElseZero(found, hn::Set(d, 1.0f)), d, result.found);
    return result;
}

// Whether the lane's hit is found. A bracket has f > 0 at its outer end, which may be the old one.
HWY_INLINE bool report_landing(const LandingResult& found, std::size_t lane, std::uint32_t octaves, Bracket& bracket,
                               Hit& hit) {
    const double s = bracket.guess;
    bracket.outside = std::max(bracket.outside, s + static_cast<double>(found.outside[lane]));
    bracket.inside = std::max(bracket.outside, std::min(bracket.inside, s + static_cast<double>(found.inside[lane])));
    bracket.guess = std::clamp(s + static_cast<double>(found.root[lane]), bracket.outside, bracket.inside);
    ++hit.steps;
    hit.noise_evaluations += octaves;
    if (found.found[lane] == 0.0f) return false;
    hit.state = HitState::hit;
    hit.s = bracket.guess;
    hit.s_outside = bracket.outside;
    hit.gradient = {found.gradient[0][lane], found.gradient[1][lane], found.gradient[2][lane]};
    hit.octaves = octaves;
    return true;
}

template <bool kPlanar>
void land_all(const Field& field, const LandingPlan& plan, std::span<const Ray> rays,
              std::span<const std::uint32_t> landing, std::span<Bracket> brackets, std::span<Hit> hits,
              std::vector<std::uint32_t>& again, TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    const auto octaves = static_cast<std::uint32_t>(plan.trace.octaves.size());
    for (std::size_t begin = 0; begin < landing.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, landing.size() - begin);
        LandingBlock block;
        for (std::size_t lane = 0; lane < count; ++lane) {
            const std::uint32_t ray = landing[begin + lane];
            take_bracket(block, lane, rays[ray], brackets[ray]);
        }
        const LandingResult found = land_block<kPlanar>(field, plan, block);
        for (std::size_t lane = 0; lane < count; ++lane) {
            const std::uint32_t ray = landing[begin + lane];
            if (!report_landing(found, lane, octaves, brackets[ray], hits[ray])) again.push_back(ray);
        }
        counters.executed_lanes += lanes * octaves;
    }
    counters.noise_evaluations += landing.size() * octaves;
    counters.steps += landing.size();
}

void LandAll(const Field& field, const LandingPlan& plan, std::span<const Ray> rays,
             std::span<const std::uint32_t> landing, std::span<Bracket> brackets, std::span<Hit> hits,
             std::vector<std::uint32_t>& again, TraceCounters& counters) {
    by_dimensions(field, [&](auto planar) HWY_ATTR {
        land_all<planar()>(field, plan, rays, landing, brackets, hits, again, counters);
    });
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(LandAll);

LandingPlan::LandingPlan(const Field& field) : trace(field.plan()) {
    const noise::NoiseBounds& bounds = field.is_planar_noise() ? noise::kBounds2 : noise::kBounds3;
    const noise::FloatErrors& errors = field.is_planar_noise() ? noise::kFloatErrors2 : noise::kFloatErrors3;
    double squares = 0.0, cubes = 0.0;
    for (const noise::Octave& octave : field.octaves()) {
        const double square = octave.amplitude * octave.frequency * octave.frequency;
        squares += square;
        cubes += square * octave.frequency;
    }
    cube = static_cast<float>(cubes * bounds.third / 6.0 * kRoundUp);
    bend_error = static_cast<float>(squares * (1.5 * errors.hessian_entry + 39 * 0x1p-24 * bounds.second) * kRoundUp);
    half_curvature = static_cast<float>(Bracketer::half_curvature(field));
    // A little less deep, for the base is rounded.
    if (half_curvature > 0.0f) deepest = static_cast<float>(-0.999 * field.amplitude());
}

void Lander::land(std::span<const Ray> rays, std::span<const std::uint32_t> landing, std::span<Bracket> brackets,
                  std::span<Hit> hits, std::vector<std::uint32_t>& again, TraceCounters& counters) const {
    HWY_DYNAMIC_DISPATCH(LandAll)(field_, plan_, rays, landing, brackets, hits, again, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
