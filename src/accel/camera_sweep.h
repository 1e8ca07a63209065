// How a moving camera's rays through the same point of the screen differ over a time.
#pragma once

#include <optional>

#include "src/accel/screen_cells.h"
#include "src/scene/camera_path.h"
#include "src/trace/camera.h"

namespace strata::accel {

// From the ray at the middle of the time.
struct CameraSweep {
    double shift = 0.0;  // of the eye, world units
    double angle = 0.0;  // of directions, radians
};

// Upper bounds for every point of the cell and every time of it; none where the camera moves too much, or looks so
// nearly along `up` that it may turn at once. camera: the path's at the middle of the cell's time.
std::optional<CameraSweep> sweep_camera(const scene::CameraPath& path, const trace::Camera& camera,
                                        const ScreenCell& cell);

}  // namespace strata::accel
