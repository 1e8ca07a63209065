#include "src/integrate/inherit.h"

namespace strata::integrate {

void inherit(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::span<const std::uint32_t> samples,
             SurfaceChunk& next) {
    const std::size_t count = samples.size();
    const auto take = [&](const auto& from, auto& to) {
        to.resize(from.empty() ? 0 : count);
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[samples[i]];
    };
    take(chunk.ids, next.ids);
    take(chunk.time, next.time);
    take(chunk.to_sky, next.to_sky);
    if (chunk.directions_a_light == 1) {
        next.directions_a_light = 1;
        next.to_light = chunk.to_light;
        return;
    }
    const std::size_t lights = setup.lights.size();
    next.directions_a_light = count;
    next.to_light.resize(lights * count);
    for (std::size_t l = 0; l < lights; ++l) {
        for (std::size_t i = 0; i < count; ++i)
            next.to_light[l * count + i] = chunk.to_light[l * chunk.directions_a_light + samples[i]];
    }
}

}  // namespace strata::integrate
