// Channels beside colour: each filter does what it says, whatever the estimator and however the picture is cut up.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "src/render/render.h"
#include "src/scene/enum_names.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::render;
using scene::EstimatorKind;

namespace {

constexpr Rect kFrame{0, 0, 40, 70};

// A sample's colour, as a channel of each filter.
constexpr std::array kColours{
    Channel{"picture", ChannelType::colour, ChannelFilter::picture, "", "", nullptr},
    Channel{"mean", ChannelType::colour, ChannelFilter::mean, "", "", nullptr},
    Channel{"nearest", ChannelType::colour, ChannelFilter::nearest, "", "", nullptr},
    Channel{"min", ChannelType::colour, ChannelFilter::min, "", "", nullptr},
};

ChannelSet colours() {
    std::vector<const Channel*> channels;
    for (const Channel& channel : kColours) channels.push_back(&channel);
    return ChannelSet(channels);
}

// Where sample and shutter are, as colour and in all channels.
class Repeated final : public ImageFunction {
  public:
    void evaluate(const SampleBatch& samples, const SampleOut& out, Counters&) const override {
        for (std::size_t i = 0; i < samples.u.size(); ++i) {
            const double u = samples.u[i], v = samples.v[i];
            out.radiance[i] = glm::vec3(u, std::sin(3 * u + 7 * v), 1000 * samples.t[i] - v);
            if (!out.has_channels()) continue;
            for (const ChannelSet::Entry& entry : out.channels->entries()) {
                std::copy_n(&out.radiance[i].x, entry.count, &out.values[i * out.channels->values() + entry.first]);
            }
        }
    }
};

Estimator estimator(EstimatorKind kind, int N = 3) {
    EstimatorSettings settings;
    settings.kind = kind;
    settings.N = kind == EstimatorKind::none ? 1 : N;
    settings.m = 3;
    settings.shutter = {.open_s = 0.04};
    return Estimator(settings);
}

RenderResult render_colours(EstimatorKind kind, const Rect& window, int threads, int tile) {
    RenderOptions options;
    options.threads = threads;
    options.tile = tile;
    options.channels = colours();
    return render::render(Repeated(), estimator(kind), window, options);
}

// The colours of the samples that an estimator that shares none places for a pixel, and how far from its centre.
struct Sample {
    glm::vec3 colour;
    double distance;
};

std::vector<Sample> own_samples(EstimatorKind kind, int x, int y) {
    std::vector<Sample> samples;
    for (const ProbeSample& probe : estimator(kind).probe_samples(x, y)) {
        const double u = x + 0.5 + probe.u, v = y + 0.5 + probe.v;
        glm::vec3 colour;
        Counters counters;
        Repeated().evaluate({{&u, 1}, {&v, 1}, {&probe.time_s, 1}}, std::span(&colour, 1), counters);
        samples.push_back({colour, std::hypot(probe.u, probe.v)});
    }
    return samples;
}

glm::vec3 component(const Film& film, int x, int y, std::size_t channel) {
    const std::span<const float> values = film.channels_at(x, y).subspan(3 * channel);
    return {values[0], values[1], values[2]};
}

constexpr EstimatorKind kKinds[] = {EstimatorKind::none,     EstimatorKind::super,  EstimatorKind::uniform,
                                    EstimatorKind::jittered, EstimatorKind::random, EstimatorKind::stratified,
                                    EstimatorKind::sobol,    EstimatorKind::shared, EstimatorKind::shared_sobol};

}  // namespace

TEST_CASE("colour as a channel that is filtered like the picture is the picture, to the last bit") {
    for (const EstimatorKind kind : kKinds) {
        CAPTURE(scene::name_of(kind));
        const RenderResult result = render_colours(kind, kFrame, 2, 16);
        int wrong = 0;
        for (int y = 0; y < kFrame.y1; ++y) {
            for (int x = 0; x < kFrame.x1; ++x) wrong += component(result.film, x, y, 0) != result.film.at(x, y);
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("mean, nearest and min are those of the samples that the estimator places for the pixel") {
    for (const EstimatorKind kind : kKinds) {
        if (estimator(kind).shared()) continue;
        CAPTURE(scene::name_of(kind));
        const RenderResult result = render_colours(kind, kFrame, 2, 16);
        for (const glm::ivec2& pixel : {glm::ivec2(0, 0), glm::ivec2(17, 33), glm::ivec2(39, 69)}) {
            const std::vector<Sample> samples = own_samples(kind, pixel.x, pixel.y);
            const auto nearest = std::ranges::min_element(samples, {}, &Sample::distance);
            glm::dvec3 sum(0.0);
            glm::vec3 least = samples[0].colour;
            for (const Sample& sample : samples) {
                sum += glm::dvec3(sample.colour);
                least = glm::min(least, sample.colour);
            }
            const glm::dvec3 mean = sum / static_cast<double>(samples.size());
            const glm::dvec3 found(component(result.film, pixel.x, pixel.y, 1));
            CHECK(glm::length(found - mean) <= 1e-6 * (1.0 + glm::length(mean)));
            // A probed position is rounded once more.
            const glm::vec3 off = component(result.film, pixel.x, pixel.y, 2) - nearest->colour;
            CHECK(glm::length(off) < 1e-4f);
            CHECK(glm::length(component(result.film, pixel.x, pixel.y, 3) - least) < 1e-4f);
        }
    }
}

TEST_CASE("of shared samples, those in the pixel's own square make mean, nearest and min") {
    for (const EstimatorKind kind : {EstimatorKind::shared, EstimatorKind::shared_sobol}) {
        const RenderResult result = render_colours(kind, kFrame, 2, 16);
        int outside = 0;
        for (int y = 0; y < kFrame.y1; ++y) {
            for (int x = 0; x < kFrame.x1; ++x) {
                // Red is where the sample lies along the row.
                const float mean = component(result.film, x, y, 1).r - static_cast<float>(x);
                const float nearest = component(result.film, x, y, 2).r - static_cast<float>(x);
                const float least = component(result.film, x, y, 3).r - static_cast<float>(x);
                outside += least < 0.0f || least > nearest || least > mean;
                outside += mean < 0.2f || mean > 0.8f || nearest < 0.05f || nearest > 0.95f;
            }
        }
        CHECK(outside == 0);
    }
}

TEST_CASE("channels do not depend on threads, tiles and crop, and change no pixel") {
    for (const EstimatorKind kind : kKinds) {
        CAPTURE(scene::name_of(kind));
        const RenderResult whole = render_colours(kind, kFrame, 1, 32);
        CHECK(render_colours(kind, kFrame, 3, 7).film.channels() == whole.film.channels());
        CHECK(render::render(Repeated(), estimator(kind), kFrame).film.pixels() == whole.film.pixels());
        const Rect crop{5, 9, 31, 66};
        const RenderResult part = render_colours(kind, crop, 2, 16);
        int wrong = 0;
        for (int y = crop.y0; y < crop.y1; ++y) {
            for (int x = crop.x0; x < crop.x1; ++x) {
                wrong += std::ranges::equal(part.film.channels_at(x, y), whole.film.channels_at(x, y)) ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("of samples that are equally near to the centre the first is nearest") {
    // Four centres of a pixel's quarters.
    const Estimator even = estimator(EstimatorKind::super, 2);
    RenderOptions options;
    options.channels = colours();
    const RenderResult result = render::render(Repeated(), even, kFrame, options);
    for (int x = 0; x < kFrame.x1; ++x) {
        CHECK(component(result.film, x, 5, 2).r == doctest::Approx(x + 0.5 + even.probe_samples(x, 5)[0].u));
    }
}

TEST_CASE("a film without channels takes what it took: 13 bytes a pixel, 21 with weights") {
    CHECK(Film({0, 0, 10, 10}).bytes() == 1300);
    CHECK(Film({0, 0, 10, 10}, {.weights = true}).bytes() == 2100);
    CHECK(Film({0, 0, 10, 10}, {.channel_values = 5}).bytes() == 3300);
}
