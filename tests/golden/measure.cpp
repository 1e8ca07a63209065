#include "tests/golden/measure.h"

#include <algorithm>
#include <span>

#include "src/render/progressive.h"
#include "src/render/render.h"
#include "tests/golden/digest.h"

namespace strata::golden {

namespace {

integrate::ChannelSet channels_of(const GoldenScene& golden) {
    std::vector<const integrate::Channel*> channels;
    for (const std::string& name : golden.channels) channels.push_back(integrate::find_channel(name));
    return integrate::ChannelSet(channels, scene::names_of(scene_of(golden).ground));
}

render::RenderResult render_golden(const GoldenScene& golden, const scene::Scene& scene, const Cut& cut) {
    const auto image = integrate::make_image(scene, golden.tracer);
    const estimate::EstimatorSettings settings = estimate::estimator_settings(scene);
    const film::Rect frame{0, 0, scene.film.width, scene.film.height};
    const film::Rect window = golden.crop.value_or(frame);
    render::RenderOptions options;
    options.threads = cut.threads;
    options.tile = cut.tile;
    options.channels = channels_of(golden);
    if (golden.passes == 1) return render::render(*image, estimate::Estimator(settings), window, options);
    return render::render_progressively(*image, settings, window, {.passes = golden.passes}, options).render;
}

image::Picture picture_of(const film::Film& film, const scene::Film& frame) {
    const film::Rect& w = film.window();
    image::Picture picture{frame.width, frame.height, w.x0, w.y0, w.x1, w.y1, {}};
    for (const glm::vec3& pixel : film.pixels()) picture.rgb.insert(picture.rgb.end(), {pixel.r, pixel.g, pixel.b});
    return picture;
}

// Of all pixels, all components of one channel.
std::string channel_digest(const film::Film& film, std::size_t of_pixel, const integrate::ChannelSet::Entry& entry) {
    std::vector<float> values;
    for (std::size_t i = entry.first; i < film.channels().size(); i += of_pixel) {
        for (std::size_t c = 0; c < entry.count; ++c) values.push_back(film.channels()[i + c]);
    }
    return digest_text(std::span<const float>(values));
}

Record record_of(const GoldenScene& golden, const render::RenderResult& result, const image::Picture& picture) {
    Record record;
    record.digests.emplace_back("pixels", pixels_digest(picture));
    const integrate::ChannelSet channels = channels_of(golden);
    for (const integrate::ChannelSet::Entry& entry : channels.entries()) {
        record.digests.emplace_back(std::string(entry.channel->name) + "_aov",
                                    channel_digest(result.film, channels.values(), entry));
    }
    const integrate::Counters& c = result.counters;
    for (const auto& [name, count] : integrate::kCounters) {
        const std::string pinned = name == std::string_view("noise_evaluations") ? "evaluations" : name;
        record.counts.emplace_back("total." + pinned, c.*count);
    }
    for (std::size_t i = 0; i < integrate::kPhases; ++i) {
        const integrate::PhaseCost& cost = c.phases[i];
        const std::string phase = phase_key(static_cast<integrate::Phase>(i));
        record.counts.insert(record.counts.end(), {{phase + ".evaluations", cost.noise_evaluations},
                                                   {phase + ".steps", cost.steps},
                                                   {phase + ".too_fine", cost.left_out.too_fine},
                                                   {phase + ".settled", cost.left_out.settled},
                                                   {phase + ".in_window", cost.left_out.in_window}});
    }
    return record;
}

}  // namespace

std::string phase_key(integrate::Phase phase) {
    std::string key = integrate::name_of(phase);
    std::replace(key.begin(), key.end(), ' ', '_');
    return key;
}

std::string pixels_digest(const image::Picture& picture) { return digest_text(std::span<const float>(picture.rgb)); }

Measurement measure(const GoldenScene& golden, const Cut& cut) {
    const scene::Scene scene = scene_of(golden);
    const render::RenderResult result = render_golden(golden, scene, cut);
    Measurement measurement;
    measurement.picture = picture_of(result.film, scene.film);
    measurement.record = record_of(golden, result, measurement.picture);
    return measurement;
}

}  // namespace strata::golden
