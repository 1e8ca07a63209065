#include "src/integrate/channels.h"

namespace strata::integrate {

namespace {

void add(SampleCost& cost, const trace::Hit& hit) {
    cost.steps += hit.steps;
    cost.noise_evaluations += hit.noise_evaluations;
}

}  // namespace

// Of the rays, their hits' normals, shadow rays and sky rays. Normals take the octaves that were missing from the hits'
// gradients.
void fill_channels(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    const auto octaves = static_cast<std::uint32_t>(setup.field.evaluations());
    chunk.costs.assign(chunk.rays.size(), {});
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) add(chunk.costs[i], chunk.hits[i]);
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        const trace::Hit& hit = chunk.surface_hits[i];
        if (!hit.on_bound) chunk.costs[chunk.sample[i]].noise_evaluations += octaves - hit.octaves;
    }
    for (std::size_t i = 0; i < chunk.shadow.hits.size(); ++i)
        add(chunk.costs[chunk.sample[chunk.shadow.owner[i]]], chunk.shadow.hits[i]);
    if (!setup.has_sky_rays || chunk.depth > setup.scene.sky.bounces) return;
    fill_channels(setup, *chunk.next);
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        SampleCost& cost = chunk.costs[chunk.sample[i]];
        cost.steps += chunk.next->costs[i].steps;
        cost.noise_evaluations += chunk.next->costs[i].noise_evaluations;
    }
}

}  // namespace strata::integrate
