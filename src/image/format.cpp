#include "src/image/format.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "src/image/image_error.h"
#include "src/image/stream_target.h"

namespace strata::image {
namespace {

constexpr int kMaxJpegSide = 65500;  // JPEG_MAX_DIMENSION of libjpeg, which ends the process beyond it

constexpr std::array<std::pair<const char*, Format>, 6> kExtensions{{
    {".exr", Format::exr},
    {".png", Format::png},
    {".tif", Format::tiff},
    {".tiff", Format::tiff},
    {".jpg", Format::jpeg},
    {".jpeg", Format::jpeg},
}};

}  // namespace

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

std::optional<Format> known_format(std::string_view extension) {
    for (const auto& [known, format] : kExtensions)
        if (extension == known) return format;
    return std::nullopt;
}

Format format_of(const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    if (const auto format = known_format(extension)) return *format;
    if (const auto stream = stream_target(path)) return stream->format.value_or(Format::exr);
    const std::string found =
        extension.empty() ? "it has no extension" : fmt::format("its extension is \"{}\"", path.extension().string());
    throw ImageError(
        fmt::format("cannot tell the picture format of \"{}\": {}; known are .exr, .png, .tif, .tiff, .jpg, .jpeg",
                    path.string(), found));
}

const char* name_of(Format format) {
    switch (format) {
        case Format::exr:
            return "openexr";
        case Format::png:
            return "png";
        case Format::tiff:
            return "tiff";
        case Format::jpeg:
            break;
    }
    return "jpeg";
}

void check_size(const std::filesystem::path& path, int width, int height) {
    if (format_of(path) != Format::jpeg || (width <= kMaxJpegSide && height <= kMaxJpegSide)) return;
    throw ImageError(fmt::format("cannot write \"{}\": a JPEG has at most {} pixels a side, this picture is {}x{}",
                                 path.string(), kMaxJpegSide, width, height));
}

}  // namespace strata::image
