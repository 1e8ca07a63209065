#include "tools/job/aov.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "src/estimate/pixel_channels.h"
#include "src/integrate/cryptomatte.h"
#include "src/scene/key_text.h"
#include "tools/cli/errors.h"

namespace strata::tools::job {

namespace {

using integrate::Channel;
using integrate::ChannelSet;

template <class Channels>
std::string join_names(const Channels& channels) {
    std::string names;
    for (const Channel* channel : channels) names += (names.empty() ? "" : ",") + std::string(channel->name);
    return names;
}

std::vector<const Channel*> channels_of(const ChannelSet& aovs) {
    std::vector<const Channel*> channels;
    for (const ChannelSet::Entry& entry : aovs.entries()) channels.push_back(entry.channel);
    return channels;
}

std::vector<const Channel*> every_channel() {
    std::vector<const Channel*> channels;
    for (const Channel& channel : integrate::all_channels()) channels.push_back(&channel);
    return channels;
}

}  // namespace

ChannelSet parse_aovs(const std::string& text, const estimate::EstimatorSettings& estimator,
                      std::vector<std::string> grounds) {
    const auto has = [&](const Channel* channel) { return estimate::has_filter(estimator, channel->filter); };
    const auto has_ground = [&](const Channel* channel) { return !is_of_ground(channel->type) || !grounds.empty(); };
    std::vector<const Channel*> channels;
    if (text == "all") {
        std::ranges::copy_if(every_channel(), std::back_inserter(channels),
                             [&](const Channel* channel) { return has(channel) && has_ground(channel); });
        return ChannelSet(channels, std::move(grounds));
    }
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const Channel* channel = integrate::find_channel(std::string_view(text).substr(begin, end - begin));
        begin = end + 1;
        if (channel == nullptr) {
            throw cli::UsageError(
                fmt::format("--aov {}: allowed: all, or some of {}", scene::excerpt(text), all_aov_names()));
        }
        if (!has(channel)) {
            throw cli::UsageError(fmt::format("--aov {}: allowed with -N of 2 or more and one of the estimators {}",
                                              channel->name, scene::names_where(&scene::EstimatorRow::tells_variance)));
        }
        if (!has_ground(channel)) {
            throw cli::UsageError(
                fmt::format("--aov {}: allowed of a scene that has layers of ground, [[ground]]", channel->name));
        }
        channels.push_back(channel);
    }
    return ChannelSet(channels, std::move(grounds));
}

ChannelSet aovs_of(const std::string& typed, const cli::LoadedScene& loaded, int passes) {
    if (typed.empty() && !loaded.aovs) return {};
    ChannelSet aovs = parse_aovs(!typed.empty() ? typed : *loaded.aovs, estimate::estimator_settings(loaded.scene),
                                 scene::names_of(loaded.scene.ground));
    if (passes > 1) {
        throw cli::UsageError("--aov: allowed with one pass; not with --passes, --target-rmse or --time-limit");
    }
    return aovs;
}

std::string names_of(const ChannelSet& aovs) { return join_names(channels_of(aovs)); }

std::string all_aov_names() { return join_names(every_channel()); }

std::string aov_table() {
    std::string table;
    for (const Channel& channel : integrate::all_channels()) {
        table += fmt::format("  {:<11} {:<8} {}, in {}\n", channel.name, integrate::name_of(channel.filter),
                             channel.meaning, channel.unit);
    }
    return table;
}

std::vector<std::string> aov_channels(const ChannelSet& aovs, const std::string& prefix) {
    std::vector<std::string> names;
    for (const Channel* channel : channels_of(aovs)) {
        const std::vector<std::string> of_channel = integrate::file_channels(*channel, prefix, aovs.grounds());
        names.insert(names.end(), of_channel.begin(), of_channel.end());
    }
    return names;
}

std::vector<std::pair<std::string, std::string>> aov_header(const ChannelSet& aovs, const std::string& prefix) {
    if (!aovs.has(integrate::ChannelFilter::ranks)) return {};
    return integrate::crypto_header(integrate::crypto_name(prefix), aovs.grounds());
}

std::string description_of(const Channel& channel) {
    return fmt::format("{}; {}; {}", integrate::name_of(channel.filter), channel.unit, channel.meaning);
}

bool is_drawn(const Channel& channel) { return channel.type == integrate::ChannelType::work; }

}  // namespace strata::tools::job
