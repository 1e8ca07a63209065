// The camera over time, through its keys.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "src/scene/scene.h"

namespace strata::scene {

// Times [first, last] in seconds.
struct TimeSpan {
    double first = 0.0;
    double last = 0.0;
};

// When samples of the scene's frame can be taken: the support of its time filter.
TimeSpan open_shutter(const Scene& scene);

// `linear` goes straight from key to key. `smooth` is a cubic on each interval with a continuous velocity at all times:
// at a key each coordinate has the slope of the parabola through it and its neighbours, weighted by their distances in
// time, but 0 where the coordinate turns round and at most three times the lesser of the slopes on both sides, so that
// between two keys it stays between their values (F. N. Fritsch, R. E. Carlson: Monotone piecewise cubic
// interpolation, SIAM J. Numer. Anal. 17, 1980). The first and last keys have slope 0: the camera sets off and comes to
// rest there, and stays before and after. Coordinates go separately, so the way between keys depends on the axes.
class CameraPath {
  public:
    explicit CameraPath(const Camera& camera);

    // Whether cameras at different times can differ.
    bool moves() const { return knots_.size() > 1; }

    // Whether cameras at different times in that span can differ: keys around it do.
    bool moves_during(const TimeSpan& span) const;

    // Without keys, at any time.
    Camera at(double t) const;

    // Points whose convex hull holds every position in that time.
    std::vector<glm::dvec3> position_hull(const TimeSpan& span) const { return hull(span, position_of); }

    // The same of look_at - position.
    std::vector<glm::dvec3> view_hull(const TimeSpan& span) const { return hull(span, view_of); }

    // The same of (fov_deg, 0, 0).
    std::vector<glm::dvec3> fov_hull(const TimeSpan& span) const { return hull(span, fov_of); }

    // The first time found, if any, at which position and look_at are closer than `least`. Every time is covered unless
    // they stay within rounding of that distance for long.
    std::optional<double> meeting_time(double least) const;

  private:
    // Position, look_at, fov_deg.
    using Pose = std::array<double, 7>;
    struct Knot {
        double time_s;
        Pose value, slope;
    };
    using Cubic = std::array<Pose, 4>;  // Bezier's control points

    static glm::dvec3 position_of(const Pose& p) { return {p[0], p[1], p[2]}; }
    static glm::dvec3 view_of(const Pose& p) { return glm::dvec3(p[3], p[4], p[5]) - position_of(p); }
    static glm::dvec3 fov_of(const Pose& p) { return {p[6], 0.0, 0.0}; }
    std::vector<glm::dvec3> hull(const TimeSpan& span, glm::dvec3 (*of)(const Pose&)) const;

    Pose slope_at(std::size_t knot) const;
    Cubic cubic(std::size_t interval) const;
    std::size_t interval_at(double t) const;
    Pose pose(double t) const;

    Camera camera_;  // without keys
    bool smooth_;
    std::vector<Knot> knots_;
};

}  // namespace strata::scene
