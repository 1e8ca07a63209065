#include "src/accel/camera_sweep.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/trace/rounding_pad.h"

namespace strata::accel {

namespace {

using Points = std::vector<glm::dvec3>;

// Covers the rounding of an angle near zero, where a factor does not.
constexpr double kSlack = 1e-12;

// Looking more nearly along `up` (sine), or past it, the camera's right can turn at once.
constexpr double kLeastSine = 1e-3;

// The greatest angle, as a chord of the unit circle, between `middle` and a point of the hull, none of which may lie at
// a right angle to it or beyond. The directions within an angle below 90 degrees of one are convex, so the hull's
// corners tell.
std::optional<double> greatest_chord(const Points& hull, const glm::dvec3& middle) {
    const glm::dvec3 axis = glm::normalize(middle);
    double chord = 0.0;
    for (const glm::dvec3& point : hull) {
        const double length = glm::length(point);
        if (!(glm::dot(point, axis) > kLeastSine * length)) return std::nullopt;
        chord = std::max(chord, glm::length(point / length - axis));
    }
    return chord * trace::kRoundingPad + kSlack;
}

// Of the camera's right: views across `up` are linear in the view, so their hull is the hull's.
std::optional<double> chord_of_right(const Points& views, const glm::dvec3& middle, const glm::dvec3& up) {
    const glm::dvec3 unit_up = glm::normalize(up);
    Points rights;
    double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
    for (const glm::dvec3& view : views) {
        rights.push_back(glm::cross(view, unit_up));
        shortest = std::min(shortest, glm::length(rights.back()));
        longest = std::max(longest, glm::length(view));
    }
    if (!(shortest > kLeastSine * longest)) return std::nullopt;
    return greatest_chord(rights, glm::cross(middle, unit_up));
}

// The greatest relative change of a pixel's side.
double change_of_scale(const Points& fovs, double middle_deg) {
    const auto tangent = [](double fov_deg) { return std::tan(glm::radians(0.5 * fov_deg)); };
    double change = 0.0;
    for (const glm::dvec3& fov : fovs) change = std::max(change, std::abs(tangent(fov.x) / tangent(middle_deg) - 1.0));
    return change * trace::kRoundingPad + kSlack;
}

}  // namespace

// With the view f, right r and up u of unit length, a ray goes along v = f + X r + Y u, |v| >= 1. A change of f by at
// most the chord a, of r by b and of the scale of X, Y by c changes u = r x f by at most a + b, and v by at most
// a + |X| (b + c) + |Y| (a + b + c); its direction by an angle whose sine is at most that.
std::optional<CameraSweep> sweep_camera(const scene::CameraPath& path, const trace::Camera& camera,
                                        const ScreenCell& cell) {
    const scene::Camera middle = path.at(0.5 * (cell.time.first + cell.time.last));
    const Points views = path.view_hull(cell.time);
    const glm::dvec3 view = middle.look_at - middle.position;
    const std::optional<double> forward = greatest_chord(views, view), right = chord_of_right(views, view, middle.up);
    if (!forward || !right) return std::nullopt;
    const double scale = change_of_scale(path.fov_hull(cell.time), middle.fov_deg);
    const glm::dvec2 a = glm::abs(camera.on_plane(cell.x, cell.y));
    const glm::dvec2 b = glm::abs(camera.on_plane(cell.x + cell.side, cell.y + cell.side));
    const glm::dvec2 reach = glm::max(a, b);
    const double change = (*forward + reach.x * (*right + scale) + reach.y * (*forward + *right + scale)) *
                          (1.0 + scale) * trace::kRoundingPad;
    if (!(change < 0.5)) return std::nullopt;
    CameraSweep sweep;
    sweep.angle = std::asin(change) * trace::kRoundingPad;
    for (const glm::dvec3& position : path.position_hull(cell.time)) {
        sweep.shift = std::max(sweep.shift, glm::distance(position, middle.position));
    }
    sweep.shift *= trace::kRoundingPad;
    return sweep;
}

}  // namespace strata::accel
