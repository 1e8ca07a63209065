// Expected pictures as text: what a digest cannot show when it no longer agrees.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "src/image/picture.h"

namespace strata::golden {

// Expected pictures are those of this target, which every machine has; others differ by rounding and at silhouettes.
inline constexpr const char* kReferenceTarget = "scalar";

// Rows from the top, four bytes a pixel: the sRGB codes of red, green and blue, and the lowest byte of the digest of
// its three floats, which tells 255 of 256 changes that are too small for a code.
struct ReferencePicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> bytes;
};

// Throws image::ImageError when a pixel is not finite.
ReferencePicture reference_of(const image::Picture& picture);

// "WIDTH HEIGHT" and a line of base64 for every row.
std::string print_reference(const ReferencePicture& reference);

// Throws PinError for text of any other shape.
ReferencePicture parse_reference(const std::string& text, const std::string& source_name);
ReferencePicture load_reference(const std::filesystem::path& path);

struct PictureChange {
    int pixels = 0;        // whose codes or check bytes differ
    int largest_code = 0;  // difference of two codes
};

// Of pictures of equal size.
PictureChange change_between(const ReferencePicture& expected, const ReferencePicture& got);

// Leaves render.exr, expected.png and difference.png in the folder, and says in a line what they show. Pictures of
// different sizes have no difference.png.
std::string leave_pictures(const std::filesystem::path& folder, const image::Picture& render,
                           const ReferencePicture& expected);

}  // namespace strata::golden
