#include "src/render/cell_beam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/render/bounding_ball.h"

namespace strata::render {

namespace {

// A wider cone is not worth a beam.
constexpr double kWidest = 0.5;

// Far above the rounding of what it is applied to, far below what matters.
constexpr double kPad = 1.0 + 1e-9;

}  // namespace

CellBeams::CellBeams(const scene::Scene& scene, const trace::Camera& camera, const trace::Placement& placement,
                     const trace::Field& field)
    : surface_(field.surface()),
      camera_(camera),
      placement_(placement),
      field_(field),
      limit_(scene.camera.far / placement.scale()),
      bounding_ball_(bounding_ball(field)),
      eye_distance_(glm::length(placement.point_to_local(placement.orientation(0.0), camera.position()))),
      pixel_angle_(camera.ray(0.5 * scene.film.width, 0.5 * scene.film.height).pixel_angle),
      spin_rad_per_s_(placement.moves() ? std::abs(glm::radians(surface_.spin_deg_per_s)) : 0.0) {}

// The surface turns about its own origin: a solid point of a bounded one moves by at most its angle times the ball's
// radius. Of the others the rays are turned, about an eye that moves.
CellBeams::Sweep CellBeams::sweep(double half_seconds) const {
    Sweep sweep;
    const double turn = spin_rad_per_s_ * half_seconds * kPad;
    if (std::isfinite(bounding_ball_)) {
        sweep.shift = turn * bounding_ball_;
    } else {
        sweep.shift = turn * eye_distance_;
        sweep.angle = turn;
    }
    if (field_.drifts()) sweep.noise = glm::length(surface_.drift) * half_seconds * kPad;
    return sweep;
}

// The least distance from the eye at which a ray of the cone enters the bounding ball, that of the ray closest to the
// ball's centre; infinite where none does.
double CellBeams::enters(const trace::Beam& beam, double angle) const {
    const double eye = glm::length(beam.origin);
    if (!(eye > bounding_ball_)) return 0.0;
    const glm::dvec3 inward = -beam.origin / eye;
    const double off = std::atan2(glm::length(glm::cross(beam.direction, inward)), glm::dot(beam.direction, inward));
    const double nearest = std::max(0.0, off - angle - 1e-9);
    const double half_squared = bounding_ball_ * bounding_ball_ - std::pow(eye * std::sin(nearest), 2);
    const double margin = 1e-9 * eye;
    if (half_squared <= 0.0 || std::cos(nearest) <= 0.0) return std::numeric_limits<double>::infinity();
    return std::max(0.0, eye * std::cos(nearest) - std::sqrt(half_squared) - margin);
}

std::optional<CellBeam> CellBeams::around(const ScreenCell& cell) const {
    const trace::CameraCone cone = camera_.cone(cell.x, cell.y, cell.side);
    if (!(cone.tangent <= kWidest)) return std::nullopt;
    const double middle = 0.5 * (cell.time.first + cell.time.last);
    const Sweep swept = sweep(0.5 * (cell.time.last - cell.time.first));
    const double tangent = swept.angle > 0.0 ? std::tan(std::atan(cone.tangent) + swept.angle) * kPad : cone.tangent;
    if (!(tangent <= kWidest && tangent >= 0.0)) return std::nullopt;

    const glm::dmat3 orientation = placement_.orientation(middle);
    CellBeam result;
    result.shift = 2.0 * swept.shift;
    result.cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    trace::Beam& beam = result.beam;
    beam.origin = placement_.point_to_local(orientation, camera_.position());
    beam.direction = glm::normalize(trace::Placement::direction_to_local(orientation, cone.direction));
    beam.noise_shift = field_.noise_shift(middle);
    beam.radius0 = swept.shift;
    beam.spread = tangent;
    beam.noise_radius = swept.noise;
    beam.limit = limit_ + result.shift;
    if (std::isfinite(bounding_ball_)) {
        const double entry = enters(beam, std::atan(cone.tangent));
        beam.start = entry * result.cosine;
        beam.limit = std::min(beam.limit, glm::length(beam.origin) + bounding_ball_ + swept.shift);
    }
    // At other times rays begin up to `shift` behind the eye of the interval's middle.
    beam.origin -= swept.shift * beam.direction;
    return result;
}

double CellBeams::blur(const scene::TimeSpan& time) const {
    const Sweep swept = sweep(0.5 * (time.last - time.first));
    const double distance = std::isfinite(bounding_ball_)
                                ? std::max(eye_distance_ - bounding_ball_, 0.01 * eye_distance_)
                                : std::max(eye_distance_, 1e-3);
    return 2.0 * ((swept.shift + swept.noise) / std::max(distance, 1e-300) + swept.angle) / pixel_angle_;
}

}  // namespace strata::render
