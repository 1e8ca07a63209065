#include "src/integrate/medium.h"

#include <limits>

#include "src/integrate/phase_meter.h"

namespace strata::integrate {

void apply_medium(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    if (setup.media.empty()) return;
    PhaseMeter meter(counters);
    const auto look_through = [&]<class Medium>(const Medium& medium) {
        const auto look = [&](std::size_t sample, double distance) {
            glm::vec3& radiance = chunk.radiance[sample];
            radiance = medium.along({chunk.rays[sample].origin, chunk.view_of(sample), distance}).over(radiance);
        };
        for (std::size_t i = 0; i < chunk.sample.size(); ++i) look(chunk.sample[i], chunk.surface_hits[i].s);
        if constexpr (Medium::kBeforeBackground) {
            for (std::size_t i = 0; i < chunk.hits.size(); ++i)
                if (chunk.hits[i].state == trace::HitState::miss) look(i, std::numeric_limits<double>::infinity());
        }
    };
    for (const shaders::Medium& medium : setup.media) std::visit(look_through, medium);
    meter.book(Phase::shading);
}

}  // namespace strata::integrate
