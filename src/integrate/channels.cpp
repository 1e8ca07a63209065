#include "src/integrate/channels.h"

#include <algorithm>

namespace strata::integrate {

const Channel* find_channel(std::string_view name) {
    const std::span<const Channel> all = all_channels();
    const auto found = std::ranges::find(all, name, &Channel::name);
    return found == all.end() ? nullptr : &*found;
}

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
    }
    return "";
}

std::vector<std::string> file_channels(const Channel& channel, std::string_view prefix) {
    if (prefix.empty() && channel.type == ChannelType::depth) return {std::string(channel.name)};
    std::string layer(prefix);
    if (!prefix.empty()) layer += '.';
    layer += channel.name;
    std::vector<std::string> names;
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
    }
    return "";
}

ChannelSet::ChannelSet(std::span<const Channel* const> channels) {
    for (const Channel* channel : channels) {
        if (std::ranges::find(entries_, channel, &Entry::channel) != entries_.end()) continue;
        const std::size_t count = components_of(channel->type).size();
        entries_.push_back({channel, values_, count});
        values_ += count;
    }
}

bool ChannelSet::has(ChannelFilter filter) const {
    return std::ranges::any_of(entries_, [&](const Entry& entry) { return entry.channel->filter == filter; });
}

}  // namespace strata::integrate
