// What SurfaceImage keeps of the samples that it works on at a time.
#pragma once

#include <span>
#include <vector>

#include "src/render/sample_cost.h"
#include "src/render/surface_image.h"

namespace strata::render {

// A hit on its way to radiance, in the surface's coordinates.
struct SurfaceImage::Lit {
    std::size_t sample = 0;
    glm::dvec3 normal{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 view{0.0};  // the ray's direction, as the sky lies
    glm::dvec3 sun{0.0};
    double height = 0.0;
    double distance = 0.0;
    double visibility = 1.0;
};

// What a chunk of samples needs on its way; one each thread, its memory reused from chunk to chunk.
struct SurfaceImage::Chunk {
    BeamedSamples beamed;
    std::vector<double> u, v, t;  // of samples in the order of their cells
    std::vector<double> start;    // up to where their rays are free; empty where that is not known
    std::vector<float> hint;
    std::vector<const trace::Window*> window;
    WindowChains windows;
    std::vector<glm::vec3> radiance;
    std::vector<trace::Ray> rays, shadow_rays;
    std::vector<trace::Hit> hits, surface_hits, shadow_hits;
    std::vector<glm::dvec3> view, sun, x, noise_shift;
    std::vector<glm::vec3> normal;
    std::vector<Lit> lit;
    std::vector<std::size_t> shadow_owner;
    std::vector<double> shadow_spacing;
    SunlitCells sunlit;

    void resize_samples(std::size_t count) {
        u.resize(count);
        v.resize(count);
        t.resize(count);
        start.resize(count);
        hint.resize(count);
        window.resize(count);
    }

    std::vector<SampleCost> sample_costs;
    std::span<SampleCost> costs;  // empty: not asked for

    void add_cost(std::size_t sample, const trace::Hit& hit) {
        if (costs.empty()) return;
        costs[sample].steps += hit.steps;
        costs[sample].noise_evaluations += hit.noise_evaluations;
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

}  // namespace strata::render
