// A sphere about the origin, displaced along its radius.
#ifndef STRATA_SOLID_SPHERE_H_
#define STRATA_SOLID_SPHERE_H_

#include <glm/glm.hpp>
#include <limits>
#include <string_view>

#include "src/solid/extent.h"
#include "src/solid/interval.h"

namespace strata::solid {

struct Sphere {
    static constexpr std::string_view kName = "planet";
    static constexpr std::string_view kMeaning = "|x| = radius + 3-D sum";
    static constexpr int kDimensions = 3;
    static constexpr double kSteepest = 1.0;
    static constexpr bool kIsLevel = false;

    double radius = 10.0;  // surface units

    template <class Keys>
    void keys(Keys& to) {
        to.number("radius", radius, 1e-9, 1e9, "surface units", "planet: radius of its sphere");
    }

    double value(const glm::dvec3& x) const { return glm::length(x) - radius; }
    glm::dvec3 gradient(const glm::dvec3& x) const {
        const double distance = glm::length(x);
        return distance > 0.0 ? x / distance : glm::dvec3(0.0, 1.0, 0.0);
    }

    // Whatever the relief, what lies deeper than radius - amplitude is solid: a ray gets no deeper before its first
    // hit.
    double half_curvature(double amplitude) const {
        const double least = radius - amplitude;
        return least > 0.0 ? 0.5 / least : std::numeric_limits<double>::infinity();
    }
    double height(const glm::dvec3& x) const { return value(x); }
    glm::dvec3 up(const glm::dvec3& x) const { return gradient(x); }

    // The shell that holds all hills.
    Interval clip(const glm::dvec3& origin, const glm::dvec3& direction, double limit, double amplitude) const {
        const double top = radius + amplitude;
        Interval shell = clip_ball(origin, direction, top + kClipSlack * (top + glm::length(origin)), limit);
        shell.enters_bound = false;
        return shell;
    }
    Extent extent(double amplitude) const { return {.ball = radius + amplitude}; }
    double reach(double along_rays) const { return along_rays + radius; }
};

}  // namespace strata::solid
#endif

#ifdef STRATA_SOLID_LANES
#if defined(STRATA_SOLID_SPHERE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_SOLID_SPHERE_INL_H_
#undef STRATA_SOLID_SPHERE_INL_H_
#else
#define STRATA_SOLID_SPHERE_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::solid::HWY_NAMESPACE {

template <class Point>
HWY_INLINE auto distance_of(const Point& x) {
    return root(mul_add(x.x, x.x, mul_add(x.y, x.y, mul(x.z, x.z))));
}

template <class Lanes>
HWY_INLINE typename Lanes::Base base_of(const Sphere& sphere, const typename Lanes::Point& x,
                                        const typename Lanes::Point& direction) {
    const auto distance = distance_of(x);
    const auto along = mul_add(x.x, direction.x, mul_add(x.y, direction.y, mul(x.z, direction.z)));
    return {to_float(sub(distance, Lanes::wide(sphere.radius))), to_float(quotient(along, distance))};
}

template <class Lanes>
HWY_INLINE typename Lanes::Gradient gradient_of(const Sphere& /*sphere*/, const typename Lanes::Point& x) {
    const auto scale = quotient(Lanes::wide(1.0), distance_of(x));
    return {to_float(mul(x.x, scale)), to_float(mul(x.y, scale)), to_float(mul(x.z, scale))};
}

}  // namespace strata::solid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
