#include "src/integrate/resolve.h"

#include "src/integrate/phase_meter.h"

namespace strata::integrate {

namespace {

// On the bound the noise has no part in the normal, and is not evaluated.
void find_gradients(const SurfaceSetup& setup, std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                    std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient,
                    trace::TraceCounters& counters) {
    if (setup.tracer == Tracer::fast) return setup.fast.gradients(hits, x, noise_shift, gradient, counters);
    const std::size_t octaves = setup.field.evaluations();
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (hits[i].on_bound) continue;
        gradient[i] = glm::vec3(setup.field.gradient(x[i], noise_shift.empty() ? glm::dvec3(0.0) : noise_shift[i]));
        counters.noise_evaluations += octaves;
        counters.executed_lanes += octaves;
    }
}

void gather_hits(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    chunk.sample.clear();
    chunk.surface_hits.clear();
    chunk.x.clear();
    chunk.noise_shift.clear();
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
        const trace::Ray& ray = chunk.rays[i];
        const trace::Hit& hit = chunk.hits[i];
        if (hit.state == trace::HitState::unresolved) ++counters.unresolved_rays;
        if (hit.state != trace::HitState::hit) continue;
        chunk.x.push_back(ray.origin + hit.s * ray.direction);
        if (setup.field.drifts()) chunk.noise_shift.push_back(ray.noise_shift);
        chunk.surface_hits.push_back(hit);
        chunk.sample.push_back(static_cast<std::uint32_t>(i));
    }
    counters.hits += chunk.sample.size();
}

}  // namespace

void find_normals(const SurfaceSetup& setup, std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                  std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> normal,
                  trace::TraceCounters& counters) {
    find_gradients(setup, hits, x, noise_shift, normal, counters);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (hits[i].on_bound) normal[i] = glm::vec3(setup.field.bound_normal(x[i]));
        const float length = glm::length(normal[i]);
        normal[i] = length > 0.0f ? normal[i] / length : glm::vec3(0.0f, 1.0f, 0.0f);
    }
}

void resolve_hits(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    gather_hits(setup, chunk, counters);
    chunk.normal.resize(chunk.x.size());
    meter.book(Phase::shading);
    trace::TraceCounters traced;
    find_normals(setup, chunk.surface_hits, chunk.x, chunk.noise_shift, chunk.normal, traced);
    meter.book(Phase::normals, traced);
}

}  // namespace strata::integrate
