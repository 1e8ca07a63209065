#include "src/integrate/surface_setup.h"

#include "src/scene/needs.h"

namespace strata::integrate {

SurfaceSetup::SurfaceSetup(const scene::Scene& picture, Tracer used_tracer, std::uint32_t most_steps)
    : scene(picture),
      tracer(used_tracer),
      step_limit(most_steps),
      shader(scene.material, scene.sun, scene.sky),
      field(scene.surface),
      fast(field),
      placement(scene.surface),
      path(scene.camera),
      camera(path.at(0.0), scene.film),
      sun_direction(glm::normalize(scene.sun.direction)),
      has_shadows(scene::needs_shadow_rays(scene)) {
    if (scene.sky.model == scene::SkyModel::daylight) {
        const scene::TimeSpan open = scene::open_shutter(scene);
        const double middle = 0.5 * (open.first + open.last);
        const glm::dmat3 axes = placement.resting_orientation();
        daylight.emplace(scene, trace::Placement::direction_to_local(axes, sun_direction),
                         placement.point_to_local(axes, path.at(middle).position));
    }
    if (tracer != Tracer::fast) return;
    screen_beams.emplace(scene, path, placement, field);
    if (!has_shadows) return;
    // The sun's beams are of one instant of the surface.
    if (scene::needs_time_samples(scene) && (placement.moves() || field.drifts())) return;
    const scene::TimeSpan shutter = scene::open_shutter(scene);
    const double time = 0.5 * (shutter.first + shutter.last);
    sun_beams.emplace(field, trace::Placement::direction_to_local(placement.orientation(time), sun_direction),
                      field.noise_shift(time));
    if (!sun_beams->usable()) sun_beams.reset();
}

}  // namespace strata::integrate
