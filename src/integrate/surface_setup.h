// What the stages of a surface's picture look at and never change: the scene, and what is made of it once.
#pragma once

#include <optional>

#include "shaders_cpu/terrain_material.h"
#include "src/accel/screen_beams.h"
#include "src/accel/sun_beams.h"
#include "src/integrate/daylight_scene.h"
#include "src/scene/camera_path.h"
#include "src/scene/scene.h"
#include "src/trace/camera.h"
#include "src/trace/fast_tracer.h"
#include "src/trace/field.h"
#include "src/trace/placement.h"

namespace strata::integrate {

enum class Tracer { fast, reference };

struct SurfaceSetup {
    // picture.image is `surface`, and the scene is valid.
    SurfaceSetup(const scene::Scene& picture, Tracer used_tracer, std::uint32_t most_steps);
    SurfaceSetup(const SurfaceSetup&) = delete;  // tracers and beams refer to `field`
    SurfaceSetup& operator=(const SurfaceSetup&) = delete;

    scene::Scene scene;
    Tracer tracer;
    std::uint32_t step_limit;
    shaders::TerrainShader shader;
    trace::Field field;
    trace::FastTracer fast;
    trace::Placement placement;
    scene::CameraPath path;
    trace::Camera camera;                            // where it stays, if it does
    std::optional<accel::ScreenBeams> screen_beams;  // none for the reference tracer
    std::optional<accel::SunBeams> sun_beams;        // none where they would not serve, or nothing casts shadows
    glm::dvec3 sun_direction;                        // in the world, of unit length
    bool has_shadows;
    std::optional<DaylightScene> daylight;  // in place of the chosen lights of `shader` and scene.sky
};

}  // namespace strata::integrate
