#include "src/scene/needs.h"

#include <algorithm>

#include "src/scene/camera_path.h"

namespace strata::scene {

bool noise_drifts(const Surface& surface) {
    if (surface.relief.empty() && surface.amplitude == 0.0) return false;
    const glm::dvec3& d = surface.drift;
    return d.x != 0.0 || d.z != 0.0 || (d.y != 0.0 && solid::row_of(surface.kind).dimensions != 2);
}

Motion motion(const Scene& scene) {
    if (scene.image == ImageKind::wheel) return {.wheel = scene.wheel.turns_per_s != 0.0};
    if (scene.image != ImageKind::surface) return {};
    return {.camera = CameraPath(scene.camera).moves_during(open_shutter(scene)),
            .spin = scene.surface.spin_deg_per_s != 0.0,
            .drift = noise_drifts(scene.surface),
            .clouds = clouds_drift(scene)};
}

int samples_a_pixel(const Sampling& sampling) { return sampling.samples_a_pixel(); }

bool needs_time_samples(const Scene& scene) {
    return !row_of(scene.sampling.estimator).is_single && scene.shutter.open_s > 0.0 && motion(scene).any();
}

bool needs_shadow_rays(const Scene& scene) {
    const Sun& sun = scene.sun;
    if (scene.sky.model == SkyModel::daylight) return sun.shadows;
    return sun.shadows && sun.intensity > 0.0 && sun.colour != glm::dvec3(0.0);
}

bool needs_fog_shafts(const Scene& scene) { return scene.fog.visibility_m > 0.0 && scene.fog.shafts; }

bool needs_clouds(const Scene& scene) { return std::ranges::any_of(scene.clouds, &CloudLayer::is_there); }

bool clouds_drift(const Scene& scene) { return std::ranges::any_of(scene.clouds, &CloudLayer::drifts); }

bool needs_sky_rays(const Scene& scene) { return scene.sky.light == SkyLight::rays; }

bool needs_water(const Scene& scene) { return scene.image == ImageKind::surface && scene.water.present; }

}  // namespace strata::scene
