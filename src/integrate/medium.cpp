#include "src/integrate/medium.h"

#include "src/integrate/phase_meter.h"

namespace strata::integrate {

void apply_medium(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    if (setup.media.empty()) return;
    PhaseMeter meter(counters);
    const auto look_through = [&](const auto& medium) {
        for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
            const std::uint32_t sample = chunk.sample[i];
            glm::vec3& radiance = chunk.radiance[sample];
            radiance = medium.along(chunk.view_of(sample), chunk.surface_hits[i].s).over(radiance);
        }
    };
    for (const shaders::Medium& medium : setup.media) std::visit(look_through, medium);
    meter.book(Phase::shading);
}

}  // namespace strata::integrate
