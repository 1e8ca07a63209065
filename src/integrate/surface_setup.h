// What the stages of a surface's picture look at and never change: the scene, and what is made of it once.
#pragma once

#include <optional>
#include <vector>

#include "shaders_cpu/backgrounds/all.h"
#include "shaders_cpu/lights/all.h"
#include "shaders_cpu/materials/all.h"
#include "shaders_cpu/media/all.h"
#include "shaders_cpu/water.h"
#include "src/accel/screen_beams.h"
#include "src/accel/sun_beams.h"
#include "src/scene/camera_path.h"
#include "src/scene/scene.h"
#include "src/trace/camera.h"
#include "src/trace/fast_tracer.h"
#include "src/trace/field.h"
#include "src/trace/placement.h"
#include "src/trace/window_tracer.h"

namespace strata::integrate {

enum class Tracer { fast, reference };

// A light of the scene, and what its shadow rays may be shortened by.
struct SceneLight {
    shaders::Light light;
    glm::dvec3 direction;   // in the world, of unit length
    double angular_radius;  // of its disc; 0: a point
    bool casts_shadows;
    std::optional<accel::SunBeams> beams;  // none where they would not serve, or it casts no shadows
};

struct SurfaceSetup {
    // picture.image is `surface`, and the scene is valid.
    SurfaceSetup(const scene::Scene& picture, Tracer used_tracer, std::uint32_t most_steps);
    SurfaceSetup(const SurfaceSetup&) = delete;  // tracers and beams refer to `field`
    SurfaceSetup& operator=(const SurfaceSetup&) = delete;

    scene::Scene scene;
    Tracer tracer;
    std::uint32_t step_limit;
    trace::Field field;
    trace::FastTracer fast;
    trace::WindowTracer windowed;
    trace::Placement placement;
    scene::CameraPath path;
    trace::Camera camera;                            // where it stays, if it does
    std::optional<accel::ScreenBeams> screen_beams;  // none for the reference tracer
    std::optional<shaders::DaylightScene> daylight;  // shared by what follows, if the sky is that of daylight
    std::optional<shaders::CloudScene> clouds;       // likewise, if there are any
    shaders::Material material;
    shaders::Background background;
    std::vector<SceneLight> lights;
    std::vector<shaders::Medium> media;
    std::optional<shaders::Water> water;
    bool has_shadows;  // of any light
    bool has_discs;    // any light has one
    bool has_sky_rays;
    bool has_shafts;  // the fog
    bool tells_time;  // samples to lights and media: clouds drift

    // Whether samples have more random dimensions than place and time, and which pair of them is whose: after `depth`
    // reflections the sky ray's, or light l's disc's; that of the facet of water that a sample sees; and that of a
    // place in the fog.
    bool draws_light() const { return has_discs || has_sky_rays || has_waves() || has_shafts; }
    bool has_waves() const { return water && !water->waves().is_calm(); }
    std::uint32_t sky_pair(int depth) const { return static_cast<std::uint32_t>(depth * (1 + lights.size())); }
    std::uint32_t disc_pair(int depth, std::size_t l) const {
        return sky_pair(depth) + static_cast<std::uint32_t>(1 + l);
    }
    std::uint32_t facet_pair() const { return sky_pair(scene.sky.bounces + 2); }  // after all of these
    std::uint32_t shaft_pair() const { return facet_pair() + 1; }                 // and one more for the sun's disc

  private:
    shaders::ShaderInputs shader_inputs() const {
        return {scene, daylight ? &*daylight : nullptr, clouds ? &*clouds : nullptr};
    }
};

}  // namespace strata::integrate
