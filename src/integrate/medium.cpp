#include "src/integrate/medium.h"

#include <limits>

#include "src/integrate/fog_shafts.h"
#include "src/integrate/phase_meter.h"

namespace strata::integrate {

void apply_medium(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    if (setup.has_shafts) {
        cast_shafts(setup, chunk, counters);
    } else {
        clear_shafts(chunk);
    }
    if (setup.media.empty()) return;
    PhaseMeter meter(counters);
    const auto look_through = [&]<class Medium>(const Medium& medium) {
        const auto look = [&](std::size_t sample, double distance) {
            glm::vec3& radiance = chunk.radiance[sample];
            radiance = medium.along(medium_ray(setup, chunk, sample, distance)).over(radiance);
        };
        for (std::size_t i = 0; i < chunk.sample.size(); ++i) look(chunk.sample[i], chunk.surface_hits[i].s);
        for (const WaterHit& hit : chunk.water) look(hit.sample, chunk.hits[hit.sample].s);
        if constexpr (Medium::kBeforeBackground) {
            for (std::size_t i = 0; i < chunk.hits.size(); ++i)
                if (chunk.hits[i].state == trace::HitState::miss) look(i, std::numeric_limits<double>::infinity());
        }
    };
    for (const shaders::Medium& medium : setup.media) std::visit(look_through, medium);
    meter.book(Phase::shading);
}

}  // namespace strata::integrate
