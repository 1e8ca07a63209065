#include "src/integrate/surface_setup.h"

#include <algorithm>

#include "src/scene/needs.h"

namespace strata::integrate {

namespace {

double middle_of_shutter(const scene::Scene& scene) {
    const scene::TimeSpan shutter = scene::open_shutter(scene);
    return 0.5 * (shutter.first + shutter.last);
}

std::optional<shaders::DaylightScene> daylight_of(const SurfaceSetup& setup) {
    const scene::Scene& scene = setup.scene;
    if (scene.sky.model != scene::SkyModel::daylight) return {};
    const glm::dmat3 axes = setup.placement.resting_orientation();
    return std::make_optional<shaders::DaylightScene>(
        scene, trace::Placement::direction_to_local(axes, glm::normalize(scene.sun.direction)),
        setup.placement.point_to_local(axes, setup.path.at(middle_of_shutter(scene)).position));
}

std::optional<shaders::CloudScene> clouds_of(const SurfaceSetup& setup) {
    if (!setup.daylight || !scene::needs_clouds(setup.scene)) return {};
    return std::make_optional<shaders::CloudScene>(setup.scene, *setup.daylight,
                                                   setup.daylight->tables().sun_direction());
}

// Of one direction and one instant of the surface.
std::optional<accel::SunBeams> beams_of(const SurfaceSetup& setup, const glm::dvec3& to_light, double angular_radius,
                                        bool casts_shadows) {
    if (setup.tracer != Tracer::fast || !casts_shadows || angular_radius > 0.0) return {};
    const bool moves = setup.placement.moves() || setup.field.drifts();
    if (moves && scene::needs_time_samples(setup.scene)) return {};
    const double time = middle_of_shutter(setup.scene);
    const glm::dmat3 orientation = setup.placement.orientation(time);
    accel::SunBeams beams(setup.field, trace::Placement::direction_to_local(orientation, to_light),
                          setup.field.noise_shift(time));
    if (!beams.usable()) return {};
    return beams;
}

std::vector<SceneLight> lights_of(const SurfaceSetup& setup, const shaders::ShaderInputs& inputs) {
    std::vector<SceneLight> lights;
    for (const shaders::Light& light : shaders::members_in<shaders::Light>(inputs)) {
        const auto add = [&](const auto& member) {
            const glm::dvec3& direction = member.direction();
            const bool casts_shadows = member.casts_shadows();
            const double radius = member.angular_radius();
            lights.push_back(
                {light, direction, radius, casts_shadows, beams_of(setup, direction, radius, casts_shadows)});
        };
        std::visit(add, light);
    }
    return lights;
}

}  // namespace

SurfaceSetup::SurfaceSetup(const scene::Scene& picture, Tracer used_tracer, std::uint32_t most_steps)
    : scene(picture),
      tracer(used_tracer),
      step_limit(most_steps),
      field(scene.surface),
      fast(field),
      windowed(field),
      placement(scene.surface),
      path(scene.camera),
      camera(path.at(0.0), scene.film),
      daylight(daylight_of(*this)),
      clouds(clouds_of(*this)),
      material(shaders::member_in<shaders::Material>(shader_inputs())),
      background(shaders::member_in<shaders::Background>(shader_inputs())),
      lights(lights_of(*this, shader_inputs())),
      media(shaders::members_in<shaders::Medium>(shader_inputs())),
      water(scene::needs_water(scene) ? std::make_optional<shaders::Water>(scene) : std::nullopt),
      has_shadows(std::ranges::any_of(lights, &SceneLight::casts_shadows)),
      has_discs(std::ranges::any_of(lights, [](const SceneLight& light) { return light.angular_radius > 0.0; })),
      has_sky_rays(scene::needs_sky_rays(scene)),
      has_shafts(scene::needs_fog_shafts(scene)),
      tells_time(clouds && scene::clouds_drift(scene)) {
    if (tracer == Tracer::fast) screen_beams.emplace(scene, path, placement, field);
}

}  // namespace strata::integrate
