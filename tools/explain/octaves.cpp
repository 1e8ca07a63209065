#include "tools/explain/octaves.h"

#include <fmt/format.h>

#include <algorithm>

#include "noise/bounds.h"
#include "noise/fbm.h"
#include "src/scene/camera_path.h"
#include "src/trace/camera.h"

namespace strata::tools::explain {

namespace {

// Angle of the pixel at the frame's centre, mid-shutter, in radians.
double pixel_angle(const scene::Scene& scene) {
    const scene::TimeSpan open = scene::open_shutter(scene);
    const scene::Camera still = scene::CameraPath(scene.camera).at(0.5 * (open.first + open.last));
    const trace::Camera camera(still, scene.film);
    return camera.ray(0.5 * scene.film.width, 0.5 * scene.film.height).pixel_angle;
}

}  // namespace

std::vector<OctavePlan> plan_octaves(const scene::Scene& scene) {
    const scene::Surface& surface = scene.surface;
    if (!surface.relief.empty()) return {};
    const trace::Field field(surface);
    const noise::NoiseBounds& bounds = field.is_planar_noise() ? noise::kBounds2 : noise::kBounds3;
    const double angle = pixel_angle(scene);
    const auto all = noise::make_octaves({.octaves = surface.octaves,
                                          .lacunarity = surface.lacunarity,
                                          .gain = surface.gain,
                                          .amplitude = surface.amplitude,
                                          .frequency = surface.frequency,
                                          .seed = surface.seed});
    std::vector<OctavePlan> plans;
    for (const noise::Octave& octave : all) {
        OctavePlan plan;
        plan.octave = static_cast<int>(plans.size()) + 1;
        plan.amplitude = octave.amplitude;
        plan.wavelength = surface.scale / octave.frequency;
        plan.pixel_wide_at = plan.wavelength / angle;
        if (field.base_gradient(glm::dvec3(0.0)) != glm::dvec3(0.0)) {
            plan.below_tolerance_from =
                octave.amplitude * bounds.value * surface.scale / (scene.sampling.tolerance * angle);
        }
        const bool live = std::ranges::any_of(field.octaves(), [&](const noise::Octave& other) {
            return other.frequency == octave.frequency && other.key.axis == octave.key.axis;
        });
        plan.roles.push_back({0.0, scene.camera.far, live ? "geometry" : "nothing"});
        plans.push_back(plan);
    }
    return plans;
}

std::string octaves_note(const scene::Scene& scene, integrate::Tracer tracer) {
    const std::string everywhere = fmt::format(
        "Every octave shapes hits and normals at all distances up to far = {:g}; none is dropped for being small.\n",
        scene.camera.far);
    if (tracer == integrate::Tracer::reference)
        return everywhere + "The reference tracer evaluates all of them at each step.\n";
    return everywhere +
           "On the way a fine octave is evaluated only where the coarser ones leave the sign of f open, or steps are "
           "short\n"
           "beside its cells; at a hit and for its normal all are.\n";
}

}  // namespace strata::tools::explain
