// The picture of a ray-cast surface under sun and sky, as an image function; and its rays, for those that ask for one.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/light.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

class SurfaceImage final : public ImageFunction {
  public:
    // scene.image is `surface`, and the scene is valid.
    SurfaceImage(const scene::Scene& scene, Tracer tracer, std::uint32_t step_limit = trace::kStepLimit)
        : setup_(scene, tracer, step_limit) {}

    void evaluate(const SampleBatch& samples, const SampleOut& out, Counters& counters) const override;

    // Beams are for many rays.
    std::size_t batch_samples() const override { return setup_.screen_beams ? 65536 : 2048; }

    const trace::Field& field() const { return setup_.field; }
    const trace::Placement& placement() const { return setup_.placement; }

    // The camera's ray through a point of the screen at a time, in the world, with the scene's tolerance.
    trace::Ray camera_ray(double u, double v, double t) const;

    // The same in the surface's coordinates, to the bit as the picture has it.
    trace::Ray local_camera_ray(double u, double v, double t) const;

    // A ray of the world with the tolerance that the centre of the screen has at that time.
    trace::Ray world_ray(const glm::dvec3& origin, const glm::dvec3& direction, double t) const;

    // A ray of the world at a time, in the surface's coordinates.
    trace::Ray to_local(const glm::dmat3& orientation, const trace::Ray& world, double t) const {
        return setup_.placement.to_local(orientation, world, setup_.field.noise_shift(t));
    }

    // Traces rays in the surface's coordinates.
    void trace(std::span<const trace::Ray> rays, std::span<trace::Hit> hits, trace::TraceCounters& counters) const;

    // Outward unit normals of hits, as find_normals (resolve.h) has them.
    void normals(std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                 std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> normal,
                 trace::TraceCounters& counters) const;

  private:
    SurfaceSetup setup_;
};

}  // namespace strata::integrate
