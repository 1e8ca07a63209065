#include "src/integrate/place.h"

#include "src/integrate/phase_meter.h"

namespace strata::integrate {

trace::Camera camera_at(const SurfaceSetup& setup, double t) {
    return setup.path.moves() ? trace::Camera(setup.path.at(t), setup.scene.film) : setup.camera;
}

namespace {

// What the rays of one time share.
struct Instant {
    glm::dmat3 orientation;  // of the surface
    trace::Ray world;        // some ray of the camera
    trace::Camera eye;       // in the surface's axes
    trace::Ray ray;          // in the surface's coordinates, all but its direction and tolerance
};

trace::Ray world_ray(const SurfaceSetup& setup, const trace::Camera& camera, double u, double v) {
    const trace::CameraRay seen = camera.ray(u, v);
    return {.origin = camera.position(),
            .direction = seen.direction,
            .noise_shift = {},
            .limit = setup.scene.camera.far,
            .delta0 = 0.0,
            .delta_slope = setup.scene.sampling.tolerance * seen.pixel_angle,
            .step_limit = setup.step_limit};
}

trace::Ray to_local(const SurfaceSetup& setup, const glm::dmat3& orientation, const trace::Ray& world, double t) {
    return setup.placement.to_local(orientation, world, setup.field.noise_shift(t));
}

Instant instant(const SurfaceSetup& setup, double t) {
    const trace::Camera camera = camera_at(setup, t);
    const glm::dmat3 orientation = setup.placement.orientation(t);
    const trace::Ray world = world_ray(setup, camera, 0.5 * setup.scene.film.width, 0.5 * setup.scene.film.height);
    return {orientation, world, camera.turned(orientation), to_local(setup, orientation, world, t)};
}

void set_time(const SurfaceSetup& setup, double t, Instant& now) {
    if (setup.path.moves() || setup.placement.moves()) {
        now = instant(setup, t);
    } else if (setup.field.drifts()) {
        now.ray = to_local(setup, now.orientation, now.world, t);
    }
}

void aim(const SurfaceSetup& setup, const Instant& now, double u, double v, trace::Ray& ray) {
    const trace::CameraRay seen = now.eye.ray(u, v);
    ray = now.ray;
    trace::Placement::aim(ray, seen.direction, setup.scene.sampling.tolerance * seen.pixel_angle);
}

// Of sample i, or of all of them for i = 0.
void aim_at_lights(const SurfaceSetup& setup, const Instant& now, std::size_t i, SurfaceChunk& chunk) {
    for (std::size_t l = 0; l < setup.lights.size(); ++l) {
        chunk.to_light[l * chunk.directions_a_light + i] =
            trace::Placement::direction_to_local(now.orientation, setup.lights[l].direction);
    }
}

}  // namespace

trace::Ray camera_ray(const SurfaceSetup& setup, double u, double v, double t) {
    return world_ray(setup, camera_at(setup, t), u, v);
}

trace::Ray local_camera_ray(const SurfaceSetup& setup, double u, double v, double t) {
    trace::Ray ray;
    aim(setup, instant(setup, t), u, v, ray);
    return ray;
}

// The sky does not spin with the surface.
void place_rays(const SurfaceSetup& setup, const SampleBatch& samples, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    const std::size_t count = chunk.order.size();
    const bool spins = setup.placement.moves();
    chunk.rays.resize(count);
    chunk.view.resize(spins ? count : 0);
    chunk.time.resize(setup.tells_time ? count : 0);
    chunk.directions_a_light = spins ? count : 1;
    chunk.to_light.resize(setup.lights.size() * chunk.directions_a_light);
    chunk.ids.resize(setup.draws_light() ? count : 0);
    chunk.to_sky.resize(spins && setup.has_sky_rays ? count : 0);
    if (count == 0) return;
    double time = samples.t[chunk.order.front()];
    Instant now = instant(setup, time);
    if (!spins) aim_at_lights(setup, now, 0, chunk);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t sample = chunk.order[i];
        if (samples.t[sample] != time) {  // of an instant there is one
            time = samples.t[sample];
            set_time(setup, time, now);
        }
        trace::Ray& ray = chunk.rays[i];
        aim(setup, now, samples.u[sample], samples.v[sample], ray);
        if (!chunk.time.empty()) chunk.time[i] = time;
        if (!chunk.ids.empty()) chunk.ids[i] = samples.id(sample);
        if (!spins) continue;
        chunk.view[i] = trace::Placement::direction_to_local(setup.placement.resting_orientation(),
                                                             now.orientation * ray.direction);
        aim_at_lights(setup, now, i, chunk);
        if (!chunk.to_sky.empty())
            chunk.to_sky[i] = glm::transpose(setup.placement.resting_orientation()) * now.orientation;
    }
    meter.book(Phase::shading);
}

}  // namespace strata::integrate
