// The plane y = 0 in front of a relief that is height over it: what the kinds of solids made from it have in common.
#ifndef STRATA_SOLID_PLANE_H_
#define STRATA_SOLID_PLANE_H_

#include <glm/glm.hpp>

#include "src/solid/extent.h"
#include "src/solid/interval.h"

namespace strata::solid {

struct Plane {
    static constexpr double kSteepest = 1.0;
    static constexpr bool kIsLevel = true;

    template <class Keys>
    void keys(Keys& /*to*/) {}

    double value(const glm::dvec3& x) const { return x.y; }
    glm::dvec3 gradient(const glm::dvec3& /*x*/) const { return {0.0, 1.0, 0.0}; }
    double half_curvature(double /*amplitude*/) const { return 0.0; }
    double height(const glm::dvec3& x) const { return x.y; }
    glm::dvec3 up(const glm::dvec3& /*x*/) const { return {0.0, 1.0, 0.0}; }

    Interval clip(const glm::dvec3& origin, const glm::dvec3& direction, double limit, double amplitude) const {
        return clip_below(amplitude, origin.y, direction.y, limit);
    }
    Extent extent(double /*amplitude*/) const { return {.up = {0.0, 1.0, 0.0}}; }
    double reach(double along_rays) const { return along_rays; }
};

}  // namespace strata::solid
#endif

#ifdef STRATA_SOLID_LANES
#if defined(STRATA_SOLID_PLANE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_SOLID_PLANE_INL_H_
#undef STRATA_SOLID_PLANE_INL_H_
#else
#define STRATA_SOLID_PLANE_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::solid::HWY_NAMESPACE {

template <class Lanes>
HWY_INLINE typename Lanes::Base base_of(const Plane& /*plane*/, const typename Lanes::Point& x,
                                        const typename Lanes::Point& direction) {
    return {to_float(x.y), to_float(direction.y)};
}

template <class Lanes>
HWY_INLINE typename Lanes::Gradient gradient_of(const Plane& /*plane*/, const typename Lanes::Point& /*x*/) {
    return {Lanes::number(0.0), Lanes::number(1.0), Lanes::number(0.0)};
}

}  // namespace strata::solid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
