#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/estimate/estimator.h"
#include "src/integrate/surface_image.h"
#include "src/library/scene_data.h"
#include "src/library/translate.h"
#include "src/scene/validate.h"

namespace strata {

namespace {

scene::Scene surface_scene(const Scene& scene) {
    scene::Scene valid = checked(scene);
    if (valid.image != scene::ImageKind::surface) {
        throw Error("image: this scene has no surface to probe, allowed: \"surface\"");
    }
    return valid;
}

glm::dvec3 glm_vector(const char* name, const Vector& v) {
    const bool is_finite = std::ranges::all_of(v, [](double x) { return std::isfinite(x); });
    if (!is_finite) throw Error(fmt::format("{}: not finite ({}, {}, {})", name, v[0], v[1], v[2]));
    return {v[0], v[1], v[2]};
}

Vector vector_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// The direction times a power of two, so that no square overflows or vanishes.
glm::dvec3 near_unit_length(const glm::dvec3& direction) {
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (largest == 0.0) throw Error("direction: zero, allowed: any other");
    const int exponent = std::ilogb(largest);
    return {std::scalbn(direction.x, -exponent), std::scalbn(direction.y, -exponent),
            std::scalbn(direction.z, -exponent)};
}

}  // namespace

struct Probe::Data {
    Data(const scene::Scene& valid, Tracer tracer)
        : scene(valid),
          image(scene, tracer == Tracer::fast ? integrate::Tracer::fast : integrate::Tracer::reference),
          mid_shutter_s(estimate::estimator_settings(scene).shutter.middle_s()) {}

    scene::Scene scene;
    integrate::SurfaceImage image;
    double mid_shutter_s;

    double seconds(std::optional<double> time) const {
        if (time && !std::isfinite(*time)) throw Error(fmt::format("time: not finite ({})", *time));
        return time.value_or(mid_shutter_s);
    }

    glm::dmat3 orientation_at(double t) const {
        glm::dmat3 orientation = image.placement().orientation(t);
        if (std::isfinite(orientation[0][0])) return orientation;
        throw Error(fmt::format("time: {} s, allowed: where the surface's turns can be counted in double", t));
    }

    // Beyond 2^50 cells of the finest octave, double cannot tell positions in a cell (scene/validate.h).
    void check_within_reach(const char* name, double distance) const {
        double finest = 0.0;
        for (const noise::Octave& octave : image.field().octaves()) finest = std::max(finest, octave.frequency);
        if (finest * distance <= scene::kMostCells) return;
        throw Error(
            fmt::format("{}: {:.3g} surface units from surface.origin, allowed: up to {:.3g}, where double tells the "
                        "finest octave's cells apart",
                        name, distance, scene::kMostCells / finest));
    }

    RayResult trace(const trace::Ray& world, const trace::Ray& local, double t) const;
};

// local: `world` in the surface's coordinates.
RayResult Probe::Data::trace(const trace::Ray& world, const trace::Ray& local, double t) const {
    const glm::dmat3 orientation = orientation_at(t);
    trace::Hit hit;
    trace::TraceCounters counters;
    image.trace({&local, 1}, {&hit, 1}, counters);
    RayResult result;
    result.origin = vector_of(world.origin);
    result.direction = vector_of(world.direction);
    result.steps = hit.steps;
    result.noise_evaluations = hit.noise_evaluations;
    if (hit.state == trace::HitState::unresolved) result.outcome = Outcome::unresolved;
    if (hit.state != trace::HitState::hit) return result;
    const glm::dvec3 x = local.origin + hit.s * local.direction;
    glm::vec3 normal;
    image.normals({&hit, 1}, {&x, 1}, {&local.noise_shift, 1}, {&normal, 1}, counters);
    result.outcome = Outcome::hit;
    result.distance = hit.s * image.placement().scale();
    result.position = vector_of(image.placement().point_to_world(orientation, x));
    result.normal = vector_of(orientation * glm::dvec3(normal));
    return result;
}

Probe::Probe(const Scene& scene, Tracer tracer)
    : data_(translated([&] { return std::make_unique<Data>(surface_scene(scene), tracer); })) {}
Probe::~Probe() = default;
Probe::Probe(Probe&& other) noexcept = default;
Probe& Probe::operator=(Probe&& other) noexcept = default;

FieldValue Probe::field(const Vector& position, std::optional<double> time) const {
    const trace::Field& field = data_->image.field();
    const trace::Placement& placement = data_->image.placement();
    const double t = data_->seconds(time);
    const glm::dmat3 orientation = data_->orientation_at(t);
    const glm::dvec3 x = placement.point_to_local(orientation, glm_vector("position", position));
    const glm::dvec3 shift = field.noise_shift(t);
    data_->check_within_reach("position", glm::length(x) + glm::length(shift));
    FieldValue value;
    value.f = field.value(x, shift);
    value.gradient = vector_of(orientation * field.gradient(x, shift) / placement.scale());
    for (std::size_t k = 0; k < field.octaves().size(); ++k) value.octaves.push_back(field.octave(k, x, shift));
    return value;
}

RayResult Probe::ray(const Vector& origin, const Vector& direction, std::optional<double> time) const {
    const integrate::SurfaceImage& image = data_->image;
    const double t = data_->seconds(time);
    const glm::dvec3 from = glm_vector("origin", origin);
    const glm::dvec3 along = near_unit_length(glm_vector("direction", direction));
    const double distance = glm::length(from - data_->scene.surface.origin) + data_->scene.camera.far;
    data_->check_within_reach("origin",
                              distance / image.placement().scale() + glm::length(image.field().noise_shift(t)));
    const trace::Ray world = image.world_ray(from, along, t);
    return data_->trace(world, image.to_local(data_->orientation_at(t), world, t), t);
}

RayResult Probe::screen_ray(double u, double v, std::optional<double> time) const {
    const scene::Film& film = data_->scene.film;
    if (!(u >= 0.0 && u <= film.width && v >= 0.0 && v <= film.height)) {
        throw Error(fmt::format("u, v: out of the frame ({}, {}), allowed: 0 to {} and 0 to {}", u, v, film.width,
                                film.height));
    }
    const double t = data_->seconds(time);
    data_->orientation_at(t);
    return data_->trace(data_->image.camera_ray(u, v, t), data_->image.local_camera_ray(u, v, t), t);
}

}  // namespace strata
