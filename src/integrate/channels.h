// What a picture holds beside its colour: arbitrary output variables (AOVs). Each is one row of the table in
// channel_table.cpp; film, estimators, files, options and help follow from the rows.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strata::integrate {

class SampleView;

// What the values are, which says how many there are and what their channels in a file are called.
enum class ChannelType {
    work,    // a number >= 0, NAME.Y; a picture in false colour is drawn of it as well
    number,  // NAME.Y
    colour,  // linear light or reflectance, NAME.R, NAME.G, NAME.B
    vector,  // in space, NAME.X, NAME.Y, NAME.Z
    screen,  // a vector on the screen, NAME.X, NAME.Y
    depth,   // a number in the channel NAME, without a layer
    masks,   // a number for each layer of ground, NAME.LAYER
    mattes,  // the same as a Cryptomatte, which has channels of its own (cryptomatte.h)
};

// How the values of samples become those of a pixel. All others take the samples that the estimator places for
// this very pixel; where samples are shared, those in the pixel's own square.
enum class ChannelFilter {
    picture,  // weighted as the picture's colour is
    mean,     // each of them counts alike
    nearest,  // the one nearest to the pixel's centre, of several the first
    min,      // the least, for each component
    sum,
    variance,  // of the mean: sum of (value - mean)^2 / (n (n - 1)) over n samples
    ranks,     // weighted as the picture's colour is, and then ordered, the greatest first
};

struct Channel {
    std::string_view name;  // NAME of its channels in a file, and of --aov
    ChannelType type;
    ChannelFilter filter;
    std::string_view unit;
    std::string_view meaning;
    glm::vec3 (*value)(const SampleView& sample);  // of one sample; components beyond those of the type are not used
    void (*fill)(const SampleView& sample, std::span<float> values) = nullptr;  // instead, of types with more of them
};

// All there are, in the order in which they are told.
std::span<const Channel> all_channels();

// Nothing where there is none of that name.
const Channel* find_channel(std::string_view name);

// Whether there are as many values as the scene has layers of ground: none without any.
bool is_of_ground(ChannelType type);

// The last parts of a channel's names in a file, one character a component: "XYZ". Not of types of ground.
std::string_view components_of(ChannelType type);

// "N.X", "N.Y", "N.Z"; "PREFIX.N.X" and so on with a prefix. Depth is "Z", and "PREFIX.Z.Z". `grounds` are the layers'
// names.
std::vector<std::string> file_channels(const Channel& channel, std::string_view prefix = "",
                                       std::span<const std::string> grounds = {});

// "nearest".
std::string_view name_of(ChannelFilter filter);

// Channels that are asked for. Values of a sample or a pixel lie side by side, in the order of the entries.
class ChannelSet {
  public:
    struct Entry {
        const Channel* channel;
        std::size_t first;  // of its components, among the values
        std::size_t count;
        std::size_t sampled;  // of these, the first that a sample has: all but of ranks
    };

    ChannelSet() = default;
    explicit ChannelSet(std::span<const Channel* const> channels, std::vector<std::string> grounds = {});

    bool empty() const { return entries_.empty(); }
    std::span<const Entry> entries() const { return entries_; }

    // Of a sample or a pixel.
    std::size_t values() const { return values_; }

    bool has(ChannelFilter filter) const;

    // The names of the ground's layers, and what a Cryptomatte makes of each.
    std::span<const std::string> grounds() const { return grounds_; }
    std::span<const float> ground_ids() const { return ground_ids_; }

  private:
    std::size_t values_of(ChannelType type) const;

    std::vector<Entry> entries_;  // each channel once
    std::size_t values_ = 0;
    std::vector<std::string> grounds_;
    std::vector<float> ground_ids_;
};

}  // namespace strata::integrate
