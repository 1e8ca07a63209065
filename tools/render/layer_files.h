// Channels beside a picture's colour in files of their own.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "src/integrate/channels.h"

namespace strata::tools::render {

struct LayerFile {
    std::filesystem::path path;
    integrate::ChannelSet::Entry layer;
};

// NAME.LAYER.exr for each EXR among the outputs and each layer.
std::vector<LayerFile> layer_files(const std::vector<std::filesystem::path>& outputs,
                                   const integrate::ChannelSet& layers);

// Red, green and blue of such a file: the components of the layer, a lone one three times and two with 0. `values` are
// those of pixels, `of_pixel` each.
std::vector<float> layer_pixels(const integrate::ChannelSet::Entry& layer, std::span<const float> values,
                                std::size_t of_pixel);

}  // namespace strata::tools::render
