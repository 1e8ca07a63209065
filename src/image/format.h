#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace strata::image {

enum class Format { exr, png, tiff, jpeg };

// "png" and "PNG" are the same to all who ask for a kind of file: ".png" of "a.PNG"; empty if there is none.
std::string extension_of(const std::filesystem::path& path);

// By the extension, in lower case: .exr, .png, .tif, .tiff, .jpg or .jpeg.
std::optional<Format> known_format(std::string_view extension);

// By extension, in either case. A stream (stream_target.h) without one, or a format before it, is an EXR. Throws
// ImageError for any other.
Format format_of(const std::filesystem::path& path);

// The format's name in OpenImageIO.
const char* name_of(Format format);

// Throws ImageError when a picture of this size (pixels) does not fit the format: JPEG ends at 65500 a side.
void check_size(const std::filesystem::path& path, int width, int height);

}  // namespace strata::image
