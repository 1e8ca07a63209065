#include "tools/render/layer_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/image/file_paths.h"
#include "src/image/format.h"

namespace strata::tools::render {

std::vector<LayerFile> layer_files(const std::vector<std::filesystem::path>& outputs,
                                   const integrate::ChannelSet& layers) {
    std::vector<LayerFile> files;
    for (const std::filesystem::path& output : outputs) {
        if (image::format_of(output) != image::Format::exr) continue;
        for (const integrate::ChannelSet::Entry& layer : layers.entries()) {
            files.push_back({image::derived_path(output, fmt::format(".{}.exr", layer.channel->name)), layer});
        }
    }
    return files;
}

std::vector<float> layer_pixels(const integrate::ChannelSet::Entry& layer, std::span<const float> values,
                                std::size_t of_pixel) {
    constexpr std::size_t kColours = 3;
    std::vector<float> pixels;
    pixels.reserve(values.size() / of_pixel * kColours);
    for (std::size_t begin = layer.first; begin < values.size(); begin += of_pixel) {
        const std::span<const float> components = values.subspan(begin, layer.count);
        for (std::size_t c = 0; c < kColours; ++c) {
            const float otherwise = layer.count == 1 ? components[0] : 0.0f;
            pixels.push_back(c < layer.count ? components[c] : otherwise);
        }
    }
    return pixels;
}

}  // namespace strata::tools::render
