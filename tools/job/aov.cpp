#include "tools/job/aov.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "src/estimate/pixel_channels.h"
#include "src/image/difference.h"
#include "src/image/sheet.h"
#include "src/integrate/cryptomatte.h"
#include "src/scene/key_text.h"
#include "tools/cli/errors.h"

namespace strata::tools::job {

namespace {

using integrate::Channel;
using integrate::ChannelSet;

image::Picture grey(int width, int height, float value) {
    image::Picture picture = image::make_picture(width, height);
    std::ranges::fill(picture.rgb, value);
    return picture;
}

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

CostPicture::CostPicture(const ChannelSet::Entry& aov, const film::Rect& window) : aov_(aov), window_(window) {
    const auto divide_up = [](int a, int b) { return (a + b - 1) / b; };
    block_ = divide_up(std::max(window.width(), window.height()), kLongestCostSide);
    width_ = divide_up(window.width(), block_);
    height_ = divide_up(window.height(), block_);
    sum_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0);
}

void CostPicture::add(const film::Film& strip) {
    const film::Rect& w = strip.window();
    for (int y = w.y0 - window_.y0; y < w.y1 - window_.y0; ++y) {
        double* row = &sum_[static_cast<std::size_t>(y / block_) * static_cast<std::size_t>(width_)];
        for (int x = 0; x < w.width(); ++x) {
            const double value = static_cast<double>(strip.channels_at(w.x0 + x, window_.y0 + y)[aov_.first]);
            row[x / block_] += value;
            whole_sum_ += value;
        }
    }
}

image::Canvas CostPicture::draw(const std::string& title) const {
    image::Picture picture = image::make_picture(width_, height_);
    double largest = 0;
    for (int y = 0; y < height_; ++y) {
        const int rows = std::min(block_, window_.height() - y * block_);
        for (int x = 0; x < width_; ++x) {
            const int columns = std::min(block_, window_.width() - x * block_);
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
            const double mean = sum_[i] / (1.0 * rows * columns);
            std::fill_n(&picture.rgb[3 * i], 3, static_cast<float>(mean));
            largest = std::max(largest, mean);
        }
    }
    const double top = image::scale_top(largest);
    image::Sheet sheet;
    sheet.title = title;
    const image::Canvas canvas = image::difference(picture, grey(width_, height_, 0.0f), top);
    sheet.rows = {{{canvas, "", false}}};
    sheet.scale = image::difference_scale(std::clamp(width_, 320, 640), top, std::string(aov_.channel->meaning));
    const double pixels = 1.0 * window_.width() * window_.height();
    sheet.caption = fmt::format("{}x{} pixels, mean {:.4g}, largest {:.4g}{}", window_.width(), window_.height(),
                                whole_sum_ / pixels, largest,
                                block_ > 1 ? fmt::format("; each dot the mean of {0}x{0} pixels", block_) : "");
    return image::compose(sheet);
}

}  // namespace strata::tools::job
