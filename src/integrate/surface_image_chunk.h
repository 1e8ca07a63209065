// What SurfaceImage keeps of the samples that it works on at a time.
#pragma once

#include <span>
#include <vector>

#include "src/integrate/sample_cost.h"
#include "src/integrate/surface_image.h"

namespace strata::integrate {

// What the rays of one time share.
struct SurfaceImage::Instant {
    glm::dmat3 orientation;  // of the surface
    trace::Ray world;        // some ray of the camera
    trace::Camera eye;       // in the surface's axes
    trace::Ray ray;          // in the surface's coordinates, all but its direction and tolerance
};

// A hit on its way to radiance.
struct SurfaceImage::Lit {
    std::uint32_t sample = 0;
    float visibility = 1.0f;  // of the sun
};

// What a chunk of samples needs on its way; one each thread, its memory reused from chunk to chunk.
struct SurfaceImage::Chunk {
    accel::BeamedSamples beamed;
    std::vector<double> u, v, t;  // of samples in the order of their cells
    std::vector<double> start;    // up to where their rays are free; empty where that is not known
    std::vector<float> hint;
    std::vector<const trace::Window*> window;
    accel::WindowChains windows;
    std::vector<glm::vec3> radiance;
    std::vector<trace::Ray> rays, shadow_rays;
    std::vector<trace::Hit> hits, surface_hits, shadow_hits;
    std::vector<glm::dvec3> view;  // the rays' directions, as the sky lies; empty where those are the rays' own
    std::vector<glm::dvec3> sun;   // of each sample, or of all
    std::vector<Lit> lit;          // of these, in the surface's coordinates:
    std::vector<glm::dvec3> x, noise_shift;
    std::vector<glm::vec3> normal;
    std::vector<std::size_t> shadow_owner;
    std::vector<double> shadow_spacing;
    accel::SunlitCells sunlit;

    void resize_samples(std::size_t count) {
        u.resize(count);
        v.resize(count);
        t.resize(count);
        start.resize(count);
        hint.resize(count);
        window.resize(count);
    }

    const glm::dvec3& view_of(std::size_t sample) const { return view.empty() ? rays[sample].direction : view[sample]; }
    const glm::dvec3& sun_of(std::size_t i) const { return sun.size() == 1 ? sun.front() : sun[lit[i].sample]; }
    const trace::Ray& ray_of(std::size_t i) const { return rays[lit[i].sample]; }

    std::vector<SampleCost> sample_costs;
    std::span<SampleCost> costs;  // empty: not asked for

    void add_cost(std::size_t sample, const trace::Hit& hit) {
        if (costs.empty()) return;
        costs[sample].steps += hit.steps;
        costs[sample].noise_evaluations += hit.noise_evaluations;
    }

    // Of the octaves that were missing from the hits' gradients.
    void add_normals_costs(std::uint32_t octaves) {
        if (costs.empty()) return;
        for (std::size_t i = 0; i < lit.size(); ++i) {
            if (surface_hits[i].on_bound) continue;
            costs[lit[i].sample].noise_evaluations += octaves - surface_hits[i].octaves;
        }
    }

    // What is filled hit by hit would be copied over and over while it grows: 5 to 8 % of a render.
    void reserve(std::size_t count, bool drifts, bool has_shadows) {
        surface_hits.reserve(count);
        x.reserve(count);
        lit.reserve(count);
        if (drifts) noise_shift.reserve(count);
        if (!has_shadows) return;
        shadow_rays.reserve(count);
        shadow_owner.reserve(count);
        shadow_spacing.reserve(count);
    }
};

}  // namespace strata::integrate
