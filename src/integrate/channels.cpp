#include "src/integrate/channels.h"

#include <algorithm>
#include <utility>

#include "src/integrate/cryptomatte.h"

namespace strata::integrate {

const Channel* find_channel(std::string_view name) {
    const std::span<const Channel> all = all_channels();
    const auto found = std::ranges::find(all, name, &Channel::name);
    return found == all.end() ? nullptr : &*found;
}

bool is_of_ground(ChannelType type) { return type == ChannelType::masks || type == ChannelType::mattes; }

std::string_view components_of(ChannelType type) {
    switch (type) {
        case ChannelType::work:
        case ChannelType::number:
            return "Y";
        case ChannelType::colour:
            return "RGB";
        case ChannelType::vector:
            return "XYZ";
        case ChannelType::screen:
            return "XY";
        case ChannelType::depth:
            return "Z";
        case ChannelType::masks:
        case ChannelType::mattes:
            return "";
    }
    return "";
}

std::vector<std::string> file_channels(const Channel& channel, std::string_view prefix,
                                       std::span<const std::string> grounds) {
    if (prefix.empty() && channel.type == ChannelType::depth) return {std::string(channel.name)};
    if (channel.type == ChannelType::mattes) return crypto_channels(crypto_name(prefix), grounds.size());
    std::string layer(prefix);
    if (!prefix.empty()) layer += '.';
    layer += channel.name;
    std::vector<std::string> names;
    if (channel.type == ChannelType::masks) {
        for (const std::string& ground : grounds) names.push_back(layer + '.' + ground);
    }
    for (const char component : components_of(channel.type)) names.push_back(layer + '.' + component);
    return names;
}

std::string_view name_of(ChannelFilter filter) {
    switch (filter) {
        case ChannelFilter::picture:
            return "picture";
        case ChannelFilter::mean:
            return "mean";
        case ChannelFilter::nearest:
            return "nearest";
        case ChannelFilter::min:
            return "min";
        case ChannelFilter::sum:
            return "sum";
        case ChannelFilter::variance:
            return "variance";
        case ChannelFilter::ranks:
            return "ranks";
    }
    return "";
}

ChannelSet::ChannelSet(std::span<const Channel* const> channels, std::vector<std::string> grounds)
    : grounds_(std::move(grounds)) {
    for (const std::string& ground : grounds_) ground_ids_.push_back(crypto_id(ground));
    for (const Channel* channel : channels) {
        if (std::ranges::find(entries_, channel, &Entry::channel) != entries_.end()) continue;
        const std::size_t count = values_of(channel->type);
        entries_.push_back({channel, values_, count, is_of_ground(channel->type) ? grounds_.size() : count});
        values_ += count;
    }
}

std::size_t ChannelSet::values_of(ChannelType type) const {
    if (type == ChannelType::masks) return grounds_.size();
    if (type == ChannelType::mattes) return crypto_values(grounds_.size());
    return components_of(type).size();
}

bool ChannelSet::has(ChannelFilter filter) const {
    return std::ranges::any_of(entries_, [&](const Entry& entry) { return entry.channel->filter == filter; });
}

}  // namespace strata::integrate
