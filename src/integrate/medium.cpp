#include "src/integrate/medium.h"

#include "shaders_cpu/sky.h"
#include "src/integrate/phase_meter.h"

namespace strata::integrate {

namespace {

void apply_air(const DaylightScene& daylight, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        glm::vec3& radiance = chunk.radiance[chunk.sample[i]];
        radiance = daylight.through_air(radiance, chunk.view_of(chunk.sample[i]), chunk.surface_hits[i].s);
    }
    meter.book(Phase::shading);
}

}  // namespace

void apply_medium(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    if (setup.daylight) return apply_air(*setup.daylight, chunk, counters);
    const scene::Sky& sky = setup.scene.sky;
    if (sky.haze_distance <= 0.0) return;
    PhaseMeter meter(counters);
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        glm::vec3& radiance = chunk.radiance[chunk.sample[i]];
        radiance = shaders::apply_haze(sky, radiance, chunk.surface_hits[i].s, chunk.view_of(chunk.sample[i]));
    }
    meter.book(Phase::shading);
}

}  // namespace strata::integrate
