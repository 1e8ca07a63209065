// The beam around all rays through a screen cell.
#pragma once

#include <optional>

#include "src/accel/screen_cells.h"
#include "src/scene/camera_path.h"
#include "src/scene/scene.h"
#include "src/trace/beam.h"
#include "src/trace/camera.h"
#include "src/trace/field.h"
#include "src/trace/placement.h"

namespace strata::accel {

// Where a ray can be solid, its point at distance s of its origin has an axis coordinate of at most s + shift, and at
// least s * cosine.
struct CellBeam {
    struct Margins {
        double shift = 0.0;
        double cosine = 1.0;
    };
    trace::Beam beam;
    Margins margins;
};

class CellBeams {
  public:
    CellBeams(const scene::Scene& scene, const scene::CameraPath& path, const trace::Placement& placement,
              const trace::Field& field);

    // In the surface's coordinates. None where the cone would be too wide.
    std::optional<CellBeam> around(const ScreenCell& cell) const;

    // How far the surface moves over the screen in that time, at the centre of the picture. px; an estimate.
    double blur(const scene::TimeSpan& time) const;

  private:
    // How rays of the same (u, v) at other times than the middle of an interval differ.
    struct Sweep {
        double shift = 0.0;      // of every point that can be solid
        double angle = 0.0;      // of directions, radians
        double noise = 0.0;      // of the noise
        double eye_shift = 0.0;  // what of `shift` is the eye's way towards or from the surface
    };
    // The camera at some time: in the world, and turned into the surface's axes; `origin` is where it is in the
    // surface's coordinates.
    struct Eye {
        trace::Camera world, local;
        glm::dvec3 origin;
    };
    Eye eye_at(const trace::Camera& world, double time) const;

    std::optional<Sweep> sweep(const ScreenCell& cell, const trace::Camera& camera) const;
    double enters(const trace::Beam& beam, double angle, double eye_shift) const;

    const scene::Surface& surface_;
    const scene::CameraPath& path_;
    scene::Film film_;
    bool camera_moves_;
    const trace::Placement& placement_;
    Eye eye_;  // at the shutter's middle
    const trace::Field& field_;
    double limit_;          // of rays, in the surface's units
    double bounding_ball_;  // radius around the surface's origin that holds all that is solid, padded; infinite: none
    double eye_distance_;   // from the surface's origin, in its units
    double typical_distance_;  // from the eye to what it sees, in the surface's units
    double spin_rad_per_s_;
};

}  // namespace strata::accel
