// Pictures as other programs write them.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "src/image/openimageio.h"
#include "src/image/png_chunks.h"
#include "tests/image/scratch_folder.h"

namespace strata::image {

// One row of pixels. `channels` are one letter each: "RGB", "YA". The format is that of
// the extension; values go in as they are.
struct ForeignPicture {
    std::string channels = "RGB";
    OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT;
    std::vector<float> values{};
    std::string colour_space{};  // empty: nothing said
    std::vector<unsigned char> icc_profile{};
    bool is_unassociated = false;
};

inline void write_foreign(const std::filesystem::path& path, const ForeignPicture& picture) {
    const int count = static_cast<int>(picture.channels.size());
    OIIO::ImageSpec spec(static_cast<int>(picture.values.size()) / count, 1, count, picture.type);
    for (int i = 0; i < count; ++i) spec.channelnames[static_cast<std::size_t>(i)] = picture.channels[i];
    const auto alpha = picture.channels.find('A');
    spec.alpha_channel = alpha == std::string::npos ? -1 : static_cast<int>(alpha);
    if (!picture.colour_space.empty()) spec.attribute("oiio:ColorSpace", picture.colour_space);
    if (picture.is_unassociated) spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!picture.icc_profile.empty()) {
        const OIIO::TypeDesc bytes(OIIO::TypeDesc::UINT8, static_cast<int>(picture.icc_profile.size()));
        spec.attribute("ICCProfile", bytes, picture.icc_profile.data());
    }
    const auto output = OIIO::ImageOutput::create(path.string());
    if (!output || !output->open(path.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, picture.values.data()) || !output->close())
        throw std::runtime_error("no foreign picture " + path.string());
}

// A chunk more behind IHDR.
inline void insert_png_chunk(const std::filesystem::path& png, std::string_view type, std::string_view data) {
    std::string bytes = file_bytes(png);
    bytes.insert(kPngStart, png_chunk(type, data));
    write_bytes(png, bytes);
}

// The least that the reader of profiles needs: the header, and one curve.
inline std::vector<unsigned char> icc_profile(std::string_view tag, const std::string& curve) {
    std::string profile(128, '\0');
    profile[3] = static_cast<char>(144 + curve.size());
    profile[8] = 2;
    profile.replace(12, 12, "mntrRGB XYZ ");
    profile.replace(36, 4, "acsp");
    profile += std::string("\0\0\0\1", 4) + std::string(tag) + std::string("\0\0\0\x90", 4);
    profile += std::string(3, '\0');
    profile += static_cast<char>(curve.size());
    profile += curve;
    return {profile.begin(), profile.end()};
}

inline std::string power_curve_of_icc(double power) {
    const int fixed = static_cast<int>(power * 256);
    std::string curve("curv\0\0\0\0\0\0\0\1\0\0", 14);
    curve[12] = static_cast<char>(fixed >> 8);
    curve[13] = static_cast<char>(fixed & 255);
    return curve;
}

}  // namespace strata::image
