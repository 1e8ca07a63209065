#include "src/integrate/fill_channels.h"

#include "src/integrate/sample_view.h"

namespace strata::integrate {

namespace {

void fill_sample(const SampleView& view, std::size_t sample, const SampleOut& out) {
    float* values = &out.values[sample * out.channels->values()];
    for (const ChannelSet::Entry& entry : out.channels->entries()) {
        if (entry.channel->fill != nullptr) {
            entry.channel->fill(view, {values + entry.first, entry.sampled});
            continue;
        }
        const glm::vec3 value = entry.channel->value(view);
        for (std::size_t i = 0; i < entry.count; ++i) values[entry.first + i] = value[static_cast<glm::length_t>(i)];
    }
}

}  // namespace

void fill_channels(const SurfaceSetup& setup, const SampleBatch& batch, const SurfaceChunk& chunk,
                   const SampleOut& out) {
    if (!out.has_channels()) return;
    SampleView view(setup, batch, chunk);
    for (std::size_t i = 0; i < chunk.order.size(); ++i, view.next()) fill_sample(view, chunk.order[i], out);
}

void fill_channels(const SampleOut& out) {
    if (!out.has_channels()) return;
    for (std::size_t i = 0; i < out.radiance.size(); ++i) fill_sample(SampleView(out.radiance[i]), i, out);
}

}  // namespace strata::integrate
