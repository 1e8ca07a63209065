#include "src/estimate/pixel_channels.h"

#include <algorithm>
#include <limits>

#include "src/integrate/cryptomatte.h"

namespace strata::estimate {

namespace {

using integrate::ChannelFilter;
using integrate::ChannelSet;

// One component of a pixel's samples.
struct Column {
    const PixelSamples& samples;
    std::size_t stride, component;

    std::size_t size() const { return samples.u.size(); }
    float operator[](std::size_t i) const { return samples.values[i * stride + component]; }
};

double sum(const Column& column) {
    double total = 0;
    for (std::size_t i = 0; i < column.size(); ++i) total += static_cast<double>(column[i]);
    return total;
}

double mean(const Column& column) { return sum(column) / static_cast<double>(column.size()); }

double variance_of_mean(const Column& column) {
    const double centre = mean(column), n = static_cast<double>(column.size());
    double squares = 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
        const double off = static_cast<double>(column[i]) - centre;
        squares += off * off;
    }
    return squares / (n * (n - 1.0));
}

float least(const Column& column) {
    float value = column[0];
    for (std::size_t i = 1; i < column.size(); ++i) value = std::min(value, column[i]);
    return value;
}

double weighted(const Column& column) {
    if (column.samples.weight.empty()) return mean(column);
    double sum = 0, total = 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
        sum += column.samples.weight[i] * static_cast<double>(column[i]);
        total += column.samples.weight[i];
    }
    return sum / total;
}

// Index of the sample nearest to the pixel's centre, the first of several.
std::size_t nearest_sample(const PixelSamples& samples) {
    const glm::dvec2 centre = glm::dvec2(samples.pixel) + 0.5;
    std::size_t nearest = 0;
    double least_squared = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < samples.u.size(); ++i) {
        const glm::dvec2 from_centre = glm::dvec2(samples.u[i], samples.v[i]) - centre;
        const double squared = glm::dot(from_centre, from_centre);
        if (squared >= least_squared) continue;
        least_squared = squared;
        nearest = i;
    }
    return nearest;
}

// value(column) for each component of the channels with one of the filters.
template <class Value>
void set(const ChannelSet& channels, ChannelFilter filter, const PixelSamples& samples, std::span<float> pixel,
         const Value& value) {
    for (const ChannelSet::Entry& entry : channels.entries()) {
        if (entry.channel->filter != filter) continue;
        for (std::size_t i = entry.first; i < entry.first + entry.sampled; ++i) {
            pixel[i] = static_cast<float>(value(Column{samples, channels.values(), i}));
        }
    }
}

}  // namespace

bool has_filter(const EstimatorSettings& settings, ChannelFilter filter) {
    if (filter != ChannelFilter::variance) return true;
    return scene::row_of(settings.kind).tells_variance() && settings.N > 1;
}

void filter_own(const ChannelSet& channels, const PixelSamples& samples, std::span<float> pixel) {
    const std::size_t nearest = channels.has(ChannelFilter::nearest) ? nearest_sample(samples) : 0;
    set(channels, ChannelFilter::nearest, samples, pixel, [&](const Column& column) { return column[nearest]; });
    set(channels, ChannelFilter::mean, samples, pixel, mean);
    set(channels, ChannelFilter::min, samples, pixel, least);
    set(channels, ChannelFilter::sum, samples, pixel, sum);
    set(channels, ChannelFilter::variance, samples, pixel, variance_of_mean);
}

void filter_weighted(const ChannelSet& channels, const PixelSamples& samples, std::span<float> pixel) {
    set(channels, ChannelFilter::picture, samples, pixel, weighted);
    set(channels, ChannelFilter::ranks, samples, pixel, weighted);
    order_ranks(channels, pixel);
}

void order_ranks(const ChannelSet& channels, std::span<float> pixel) {
    for (const ChannelSet::Entry& entry : channels.entries()) {
        if (entry.channel->filter != ChannelFilter::ranks) continue;
        integrate::rank_coverages(channels.ground_ids(), pixel.subspan(entry.first, entry.count));
    }
}

}  // namespace strata::estimate
