#include "src/accel/cell_beam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/accel/camera_sweep.h"
#include "src/trace/rounding_pad.h"

namespace strata::accel {

namespace {

// A wider cone is not worth a beam.
constexpr double kWidest = 0.5;

double middle_of(const scene::TimeSpan& time) { return 0.5 * (time.first + time.last); }

}  // namespace

CellBeams::CellBeams(const scene::Scene& scene, const scene::CameraPath& path, const trace::Placement& placement,
                     const trace::Field& field)
    : surface_(field.surface()),
      path_(path),
      film_(scene.film),
      camera_moves_(path.moves_during(scene::open_shutter(scene))),
      placement_(placement),
      eye_(eye_at(trace::Camera(path.at(middle_of(scene::open_shutter(scene))), scene.film),
                  middle_of(scene::open_shutter(scene)))),
      field_(field),
      limit_(scene.camera.far / placement.scale()),
      bounding_ball_(field.extent().ball * trace::kRoundingPad),
      eye_distance_(glm::length(placement.point_to_local(placement.orientation(0.0), eye_.world.position()))),
      spin_rad_per_s_(placement.moves() ? std::abs(glm::radians(surface_.spin_deg_per_s)) : 0.0) {
    const double eye_height = field.base(placement.point_to_local(placement.orientation(0.0), eye_.world.position()));
    typical_distance_ = std::isfinite(bounding_ball_) ? std::max(eye_distance_ - bounding_ball_, 0.01 * eye_distance_)
                                                      : 2.0 * std::max(std::abs(eye_height), 0.1 * field.amplitude());
    typical_distance_ = std::max(typical_distance_, 1e-300);
}

CellBeams::Eye CellBeams::eye_at(const trace::Camera& world, double time) const {
    const glm::dmat3 orientation = placement_.orientation(time);
    return {world, world.turned(orientation), placement_.point_to_local(orientation, world.position())};
}

// The surface turns about its own origin: a solid point of a bounded one moves by at most its angle times the ball's
// radius. Of the others the rays are turned, about an eye that moves.
std::optional<CellBeams::Sweep> CellBeams::sweep(const ScreenCell& cell, const trace::Camera& camera) const {
    const double half_seconds = 0.5 * (cell.time.last - cell.time.first);
    Sweep sweep;
    if (camera_moves_) {
        const std::optional<CameraSweep> swept = sweep_camera(path_, camera, cell);
        if (!swept) return std::nullopt;
        sweep.shift = swept->shift / placement_.scale() * trace::kRoundingPad;
        sweep.eye_shift = sweep.shift;
        sweep.angle = swept->angle;
    }
    if (spin_rad_per_s_ > 0.0) {
        const double turn = spin_rad_per_s_ * half_seconds * trace::kRoundingPad;
        const double eye =
            glm::length(placement_.point_to_local(placement_.resting_orientation(), camera.position())) + sweep.shift;
        if (std::isfinite(bounding_ball_)) {
            sweep.shift += turn * bounding_ball_;
        } else {
            sweep.shift += turn * eye;
            sweep.angle += turn;
        }
    }
    if (field_.drifts()) sweep.noise = glm::length(surface_.drift) * half_seconds * trace::kRoundingPad;
    return sweep;
}

// The least distance from the eye at which a ray of the cone enters the bounding ball, that of the ray closest to the
// ball's centre; infinite where none does. The eye may be elsewhere by eye_shift: as though the ball were larger.
double CellBeams::enters(const trace::Beam& beam, double angle, double eye_shift) const {
    const double eye = glm::length(beam.origin);
    const double ball = bounding_ball_ + eye_shift;
    if (!(eye > ball)) return 0.0;
    const glm::dvec3 inward = -beam.origin / eye;
    const double off = std::atan2(glm::length(glm::cross(beam.direction, inward)), glm::dot(beam.direction, inward));
    const double nearest = std::max(0.0, off - angle - 1e-9);
    const double half_squared = ball * ball - std::pow(eye * std::sin(nearest), 2);
    const double margin = 1e-9 * eye;
    if (half_squared <= 0.0 || std::cos(nearest) <= 0.0) return std::numeric_limits<double>::infinity();
    return std::max(0.0, eye * std::cos(nearest) - std::sqrt(half_squared) - margin);
}

std::optional<CellBeam> CellBeams::around(const ScreenCell& cell) const {
    const double middle = middle_of(cell.time);
    std::optional<Eye> moved;
    if (camera_moves_) {
        moved = eye_at(trace::Camera(path_.at(middle), film_), middle);
    } else if (placement_.moves()) {
        moved = eye_at(eye_.world, middle);
    }
    const Eye& eye = moved ? *moved : eye_;
    const trace::CameraCone cone = eye.local.cone(cell.x, cell.y, cell.side);
    if (!(cone.tangent <= kWidest)) return std::nullopt;
    const std::optional<Sweep> bounds = sweep(cell, eye.world);
    if (!bounds) return std::nullopt;
    const Sweep& swept = *bounds;
    const auto half_angle = [&] { return std::atan(cone.tangent) + swept.angle; };
    const double tangent = swept.angle > 0.0 ? std::tan(half_angle()) * trace::kRoundingPad : cone.tangent;
    if (!(tangent <= kWidest && tangent >= 0.0)) return std::nullopt;

    CellBeam result;
    result.margins.shift = 2.0 * swept.shift;
    result.margins.cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    trace::Beam& beam = result.beam;
    beam.origin = eye.origin;
    beam.direction = cone.direction;
    beam.noise_shift = field_.noise_shift(middle);
    beam.radius0 = swept.shift;
    beam.spread = tangent;
    beam.noise_radius = swept.noise;
    beam.limit = limit_ + result.margins.shift;
    if (std::isfinite(bounding_ball_)) {
        const double entry = enters(beam, half_angle(), swept.eye_shift);
        beam.start = entry * result.margins.cosine;
        beam.limit = std::min(beam.limit, glm::length(beam.origin) + bounding_ball_ + swept.shift);
    }
    // At other times rays begin up to `shift` behind the eye of the interval's middle.
    beam.origin -= swept.shift * beam.direction;
    return result;
}

double CellBeams::blur(const scene::TimeSpan& time) const {
    const double x = 0.5 * film_.width, y = 0.5 * film_.height;
    const std::optional<Sweep> swept = sweep({x, y, 1.0, time}, eye_.world);
    const double pixel = eye_.world.ray(x, y).pixel_angle;
    if (!swept) return 1.0 / pixel;
    return 2.0 * ((swept->shift + swept->noise) / typical_distance_ + swept->angle) / pixel;
}

}  // namespace strata::accel
