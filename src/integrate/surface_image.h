// The picture of a ray-cast surface under sun and sky, as an image function.
#pragma once

#include <memory>
#include <optional>

#include "shaders_cpu/terrain_material.h"
#include "src/accel/screen_beams.h"
#include "src/accel/sun_beams.h"
#include "src/integrate/image_function.h"
#include "src/scene/camera_path.h"
#include "src/scene/scene.h"
#include "src/trace/camera.h"
#include "src/trace/fast_tracer.h"
#include "src/trace/field.h"
#include "src/trace/placement.h"

namespace strata::integrate {

class PhaseMeter;

enum class Tracer { fast, reference };

// Rays that no tracer could settle within its step limit are drawn in this colour, to be seen.
inline constexpr glm::vec3 kUnresolvedRadiance{1.0f, 0.0f, 1.0f};

class SurfaceImage final : public ImageFunction {
  public:
    // scene.image is `surface`, and the scene is valid.
    SurfaceImage(const scene::Scene& scene, Tracer tracer, std::uint32_t step_limit = trace::kStepLimit);
    SurfaceImage(const SurfaceImage&) = delete;  // fast_ refers to field_
    SurfaceImage& operator=(const SurfaceImage&) = delete;

    void evaluate(const SampleBatch& samples, std::span<glm::vec3> radiance, Counters& counters) const override;
    void evaluate_with_costs(const SampleBatch& samples, std::span<glm::vec3> radiance, std::span<SampleCost> costs,
                             Counters& counters) const override;

    // Beams are for many rays.
    std::size_t batch_samples() const override { return beams_ ? 65536 : 2048; }

    const trace::Field& field() const { return field_; }
    const trace::Placement& placement() const { return placement_; }

    // The camera's ray through a point of the screen at a time, in the world, with the scene's tolerance.
    trace::Ray camera_ray(double u, double v, double t) const;

    // The same in the surface's coordinates, to the bit as the picture has it.
    trace::Ray local_camera_ray(double u, double v, double t) const;

    // A ray of the world with the tolerance that the centre of the screen has at that time.
    trace::Ray world_ray(const glm::dvec3& origin, const glm::dvec3& direction, double t) const;

    // A ray of the world at a time, in the surface's coordinates.
    trace::Ray to_local(const glm::dmat3& orientation, const trace::Ray& world, double t) const {
        return placement_.to_local(orientation, world, field_.noise_shift(t));
    }

    // Traces rays in the surface's coordinates.
    void trace(std::span<const trace::Ray> rays, std::span<trace::Hit> hits, trace::TraceCounters& counters) const;

    // Outward unit normals of hits in the surface's coordinates: `x` are their positions, noise_shift that of their
    // rays, or empty where nothing drifts.
    void normals(std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                 std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> normal,
                 trace::TraceCounters& counters) const;

  private:
    struct Chunk;
    struct Instant;
    struct Lit;

    void evaluate_beamed(const SampleBatch& samples, std::span<glm::vec3> radiance, std::span<SampleCost> costs,
                         Chunk& chunk, Counters& counters) const;
    void evaluate_cells(const SampleBatch& samples, std::span<const accel::BeamedCell> cells,
                        std::span<glm::vec3> radiance, std::span<SampleCost> costs, Chunk& chunk,
                        Counters& counters) const;
    void evaluate_chunk(const SampleBatch& samples, std::span<glm::vec3> radiance, Chunk& chunk,
                        Counters& counters) const;
    void gradients(std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                   std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient,
                   trace::TraceCounters& counters) const;
    Instant instant(double t) const;
    void set_time(Instant& now, double t) const;
    void aim(const Instant& now, double u, double v, trace::Ray& ray) const;
    void make_rays(const SampleBatch& samples, Chunk& chunk) const;
    void gather_hits(std::span<glm::vec3> radiance, Chunk& chunk, Counters& counters) const;
    double shadow_spacing(const Chunk& chunk, std::size_t i) const;
    void shadow(Chunk& chunk, Counters& counters, PhaseMeter& meter) const;
    glm::vec3 shade_hit(const Chunk& chunk, std::size_t i) const;
    trace::Ray camera_ray(const trace::Camera& camera, double u, double v) const;

    scene::Scene scene_;
    Tracer tracer_;
    std::uint32_t step_limit_;
    shaders::TerrainShader shader_;
    trace::Field field_;
    trace::FastTracer fast_;
    trace::Placement placement_;
    scene::CameraPath path_;
    trace::Camera camera_;  // where it stays, if it does
    std::optional<accel::ScreenBeams> beams_;
    std::optional<accel::SunBeams> sun_beams_;
    int samples_a_side_;
    glm::dvec3 sun_direction_;  // in the world, of unit length
};

}  // namespace strata::integrate
