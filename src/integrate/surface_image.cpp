#include "src/integrate/surface_image.h"

#include "src/integrate/place.h"
#include "src/integrate/resolve.h"
#include "src/integrate/surface_integrator.h"
#include "src/integrate/trace_rays.h"

namespace strata::integrate {

trace::Ray SurfaceImage::camera_ray(double u, double v, double t) const {
    return integrate::camera_ray(setup_, u, v, t);
}

trace::Ray SurfaceImage::local_camera_ray(double u, double v, double t) const {
    return integrate::local_camera_ray(setup_, u, v, t);
}

trace::Ray SurfaceImage::world_ray(const glm::dvec3& origin, const glm::dvec3& direction, double t) const {
    trace::Ray ray = camera_ray(0.5 * setup_.scene.film.width, 0.5 * setup_.scene.film.height, t);
    ray.origin = origin;
    ray.direction = glm::normalize(direction);
    return ray;
}

void SurfaceImage::trace(std::span<const trace::Ray> rays, std::span<trace::Hit> hits,
                         trace::TraceCounters& counters) const {
    trace_rays(setup_, rays, hits, counters);
}

void SurfaceImage::normals(std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                           std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> normal,
                           trace::TraceCounters& counters) const {
    find_normals(setup_, hits, x, noise_shift, normal, counters);
}

void SurfaceImage::evaluate(const SampleBatch& samples, const SampleOut& out, Counters& counters) const {
    thread_local SurfaceWork work;
    integrate_surface(setup_, samples, out, work, counters);
}

}  // namespace strata::integrate
