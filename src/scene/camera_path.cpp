#include "src/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strata::scene {

namespace {

using Points = std::array<glm::dvec3, 4>;  // control points of a cubic

// The cubic's blossom: its value where all three arguments agree.
glm::dvec3 blossom(const Points& p, double u, double v, double w) {
    const glm::dvec3 a = glm::mix(p[0], p[1], u), b = glm::mix(p[1], p[2], u), c = glm::mix(p[2], p[3], u);
    return glm::mix(glm::mix(a, b, v), glm::mix(b, c, v), w);
}

// Control points of the part [u, v] of [0, 1].
Points part(const Points& p, double u, double v) {
    return {blossom(p, u, u, u), blossom(p, u, u, v), blossom(p, u, v, v), blossom(p, v, v, v)};
}

// How far the box around the points, which holds the curve, is from the origin.
double distance_of_box(const Points& p) {
    const glm::dvec3 low = glm::min(glm::min(p[0], p[1]), glm::min(p[2], p[3]));
    const glm::dvec3 high = glm::max(glm::max(p[0], p[1]), glm::max(p[2], p[3]));
    return glm::length(glm::max(glm::max(low, -high), glm::dvec3(0.0)));
}

// Bisects where the box around the curve cannot tell.
class MeetingSearch {
  public:
    MeetingSearch(const Points& curve, double least) : curve_(curve), least_(least) {}

    std::optional<double> find(double u, double v) {
        constexpr int kMostParts = 20'000;
        for (const double end : {u, v}) {
            if (glm::length(blossom(curve_, end, end, end)) < least_) return end;
        }
        const double middle = 0.5 * (u + v);
        if (distance_of_box(part(curve_, u, v)) >= least_ || middle <= u || middle >= v) return std::nullopt;
        if (++parts_ > kMostParts) return std::nullopt;
        if (const auto found = find(u, middle)) return found;
        return find(middle, v);
    }

  private:
    const Points& curve_;
    double least_;
    int parts_ = 0;
};

// At the middle one of three knots a coordinate has these slopes before and after, over times h.
double limited_slope(double before, double after, double h_before, double h_after) {
    if (before * after <= 0.0) return 0.0;
    const double parabola = (h_after * before + h_before * after) / (h_before + h_after);
    const double most = 3.0 * std::min(std::abs(before), std::abs(after));
    return std::clamp(parabola, -most, most);
}

}  // namespace

TimeSpan open_shutter(const Scene& scene) {
    const Shutter& shutter = scene.shutter;
    const double middle = shutter.time_s() + 0.5 * shutter.open_s;
    const double half =
        row_of(scene.sampling.estimator).is_single ? 0.0 : 0.5 * shutter.open_s * scene.sampling.time_order;
    return {middle - half, middle + half};
}

CameraPath::CameraPath(const Camera& camera) : camera_(camera), smooth_(camera.interpolation == Interpolation::smooth) {
    for (const CameraKey& key : std::exchange(camera_.keys, {})) {
        const glm::dvec3 x = key.position.value_or(camera.position), to = key.look_at.value_or(camera.look_at);
        knots_.push_back({key.time_s, {x.x, x.y, x.z, to.x, to.y, to.z, key.fov_deg.value_or(camera.fov_deg)}, Pose{}});
    }
    for (std::size_t i = 1; i + 1 < knots_.size(); ++i) knots_[i].slope = slope_at(i);
    if (!knots_.empty()) camera_ = at(knots_.front().time_s);
}

CameraPath::Pose CameraPath::slope_at(std::size_t knot) const {
    const Knot &a = knots_[knot - 1], &b = knots_[knot], &c = knots_[knot + 1];
    const double h_before = b.time_s - a.time_s, h_after = c.time_s - b.time_s;
    Pose slope;
    for (std::size_t i = 0; i < slope.size(); ++i) {
        slope[i] =
            limited_slope((b.value[i] - a.value[i]) / h_before, (c.value[i] - b.value[i]) / h_after, h_before, h_after);
    }
    return slope;
}

CameraPath::Cubic CameraPath::cubic(std::size_t interval) const {
    const Knot &a = knots_[interval], &b = knots_[interval + 1];
    const double third = (b.time_s - a.time_s) / 3.0;
    Cubic points{a.value, {}, {}, b.value};
    for (std::size_t i = 0; i < a.value.size(); ++i) {
        const double straight = (b.value[i] - a.value[i]) / 3.0;
        points[1][i] = a.value[i] + (smooth_ ? third * a.slope[i] : straight);
        points[2][i] = b.value[i] - (smooth_ ? third * b.slope[i] : straight);
    }
    return points;
}

// For times from the first knot's to the last one's.
std::size_t CameraPath::interval_at(double t) const {
    const auto next =
        std::upper_bound(knots_.begin(), knots_.end(), t, [](double time, const Knot& k) { return time < k.time_s; });
    const auto after = std::clamp<std::ptrdiff_t>(next - knots_.begin(), 1, std::ssize(knots_) - 1);
    return static_cast<std::size_t>(after - 1);
}

CameraPath::Pose CameraPath::pose(double t) const {
    if (knots_.empty()) {
        const glm::dvec3 &x = camera_.position, &to = camera_.look_at;
        return {x.x, x.y, x.z, to.x, to.y, to.z, camera_.fov_deg};
    }
    if (t <= knots_.front().time_s) return knots_.front().value;
    if (t >= knots_.back().time_s) return knots_.back().value;
    const std::size_t interval = interval_at(t);
    const Knot &a = knots_[interval], &b = knots_[interval + 1];
    const double u = (t - a.time_s) / (b.time_s - a.time_s), v = 1.0 - u;
    const Cubic p = cubic(interval);
    Pose pose;
    for (std::size_t i = 0; i < pose.size(); ++i) {
        const double x =
            v * v * v * p[0][i] + 3.0 * v * v * u * p[1][i] + 3.0 * v * u * u * p[2][i] + u * u * u * p[3][i];
        // Between the knots' values but for rounding.
        pose[i] =
            std::clamp(smooth_ ? x : v * p[0][i] + u * p[3][i], std::min(p[0][i], p[3][i]), std::max(p[0][i], p[3][i]));
    }
    return pose;
}

Camera CameraPath::at(double t) const {
    Camera camera = camera_;
    if (knots_.empty()) return camera;
    const Pose p = pose(t);
    camera.position = {p[0], p[1], p[2]};
    camera.look_at = {p[3], p[4], p[5]};
    camera.fov_deg = p[6];
    return camera;
}

// Between equal keys both slopes are 0, so the camera rests there.
bool CameraPath::moves_during(const TimeSpan& span) const {
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
        const Knot &a = knots_[i], &b = knots_[i + 1];
        if (a.time_s < span.last && b.time_s > span.first && a.value != b.value) return true;
    }
    return false;
}

std::vector<glm::dvec3> CameraPath::hull(const TimeSpan& span, glm::dvec3 (*of)(const Pose&)) const {
    std::vector<glm::dvec3> hull{of(pose(span.first)), of(pose(span.last))};
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
        const double begin = knots_[i].time_s, end = knots_[i + 1].time_s;
        if (end <= span.first || begin >= span.last) continue;
        const Cubic p = cubic(i);
        Points positions;
        for (std::size_t k = 0; k < 4; ++k) positions[k] = of(p[k]);
        const double u = std::clamp((span.first - begin) / (end - begin), 0.0, 1.0);
        const double v = std::clamp((span.last - begin) / (end - begin), 0.0, 1.0);
        for (const glm::dvec3& x : part(positions, u, v)) hull.push_back(x);
    }
    return hull;
}

std::optional<double> CameraPath::meeting_time(double least) const {
    if (!moves()) {
        const double apart = glm::distance(camera_.position, camera_.look_at);
        if (apart >= least) return std::nullopt;
        return knots_.empty() ? 0.0 : knots_.front().time_s;
    }
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
        const Cubic p = cubic(i);
        Points view;
        for (std::size_t k = 0; k < 4; ++k) {
            view[k] = glm::dvec3(p[k][3], p[k][4], p[k][5]) - glm::dvec3(p[k][0], p[k][1], p[k][2]);
        }
        const double begin = knots_[i].time_s, length = knots_[i + 1].time_s - begin;
        if (const auto u = MeetingSearch(view, least).find(0.0, 1.0)) return begin + *u * length;
    }
    return std::nullopt;
}

}  // namespace strata::scene
