// What of a ball or a box is solid where the relief exceeds a threshold. The body's own surface is part of the solid's.
#ifndef STRATA_SOLID_LEVEL_SET_H_
#define STRATA_SOLID_LEVEL_SET_H_

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <string_view>

#include "src/solid/extent.h"
#include "src/solid/interval.h"

namespace strata::solid {

struct LevelSet {
    enum class Bound { ball, box };

    static constexpr std::string_view kName = "isosurface";
    static constexpr std::string_view kMeaning = "3-D sum = threshold";
    static constexpr int kDimensions = 3;
    static constexpr double kSteepest = 0.0;
    static constexpr bool kIsLevel = true;
    static constexpr std::array<std::string_view, 2> kBounds{"ball", "box"};  // in Bound's order

    double threshold = 0.0;
    Bound bound = Bound::ball;
    glm::dvec3 bound_size{1.0};  // ball: radius in x; box: half sizes

    template <class Keys>
    void keys(Keys& to) {
        to.number("threshold", threshold, -1e9, 1e9, "surface units", "isosurface: solid where the sum exceeds it");
        to.choice("bound", bound, kBounds, "isosurface: the body it is cut from");
        to.vector("bound_size", bound_size, 1e-9, 1e9, "surface units",
                  "isosurface: a ball's radius in the first number, or a box's half sizes");
    }

    double value(const glm::dvec3& /*x*/) const { return threshold; }
    glm::dvec3 gradient(const glm::dvec3& /*x*/) const { return glm::dvec3(0.0); }
    double half_curvature(double /*amplitude*/) const { return 0.0; }
    double height(const glm::dvec3& x) const { return x.y; }
    glm::dvec3 up(const glm::dvec3& /*x*/) const { return {0.0, 1.0, 0.0}; }

    // Unlike the others' slabs and shells, the bound is a surface itself and stays where it is.
    Interval clip(const glm::dvec3& origin, const glm::dvec3& direction, double limit, double /*amplitude*/) const {
        if (bound == Bound::box) return clip_box(origin, direction, bound_size, limit);
        return clip_ball(origin, direction, bound_size.x, limit);
    }
    Extent extent(double /*amplitude*/) const {
        return {.ball = bound == Bound::ball ? bound_size.x : glm::length(bound_size)};
    }

    // However far rays come from, they see nothing outside the bound.
    static constexpr std::string_view kReachKey = "surface.bound_size";
    double reach(double /*along_rays*/) const { return extent(0.0).ball; }

    // Outward normal of the bound at a point of it.
    glm::dvec3 bound_normal(const glm::dvec3& x) const {
        if (bound == Bound::ball) return glm::normalize(x);
        const glm::dvec3 scaled = glm::abs(x) / bound_size;
        glm::dvec3 normal{0.0};
        const int axis = scaled.x >= scaled.y && scaled.x >= scaled.z ? 0 : scaled.y >= scaled.z ? 1 : 2;
        normal[axis] = std::copysign(1.0, x[axis]);
        return normal;
    }
};

}  // namespace strata::solid
#endif

#ifdef STRATA_SOLID_LANES
#if defined(STRATA_SOLID_LEVEL_SET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_SOLID_LEVEL_SET_INL_H_
#undef STRATA_SOLID_LEVEL_SET_INL_H_
#else
#define STRATA_SOLID_LEVEL_SET_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::solid::HWY_NAMESPACE {

template <class Lanes>
HWY_INLINE typename Lanes::Base base_of(const LevelSet& set, const typename Lanes::Point& /*x*/,
                                        const typename Lanes::Point& /*direction*/) {
    return {Lanes::number(set.threshold), Lanes::number(0.0)};
}

template <class Lanes>
HWY_INLINE typename Lanes::Gradient gradient_of(const LevelSet& /*set*/, const typename Lanes::Point& /*x*/) {
    return {Lanes::number(0.0), Lanes::number(0.0), Lanes::number(0.0)};
}

}  // namespace strata::solid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
