#include "src/image/picture_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/image/digest.h"
#include "src/image/image_error.h"
#include "src/image/png_chunks.h"

namespace strata::image {
namespace {

// A TIFF description is read back up to 65,536 bytes, a JPEG segment holds 65,533 with its own header inside: room
// for the digest beside what is given.
constexpr std::size_t kMaxDescription = 60'000;

constexpr int kTileSide = 64;
static_assert(kStripRows % kTileSide == 0 && kStripRows % 16 == 0, "a strip holds whole tiles, and whole zip blocks");

void set_windows(OIIO::ImageSpec& spec, const PictureShape& shape) {
    spec.x = shape.x0;
    spec.y = shape.y0;
    spec.full_width = shape.frame_width;
    spec.full_height = shape.frame_height;
}

// With room for the digest, first of all: what users typed comes after it.
Metadata with_blank_digest(const Metadata& metadata) {
    Metadata result;
    result.set(kDigestKey, blank_digest());
    for (const auto& [name, value] : metadata.entries())
        if (name != kDigestKey) result.set(name, value);
    return result;
}

void set_metadata(OIIO::ImageSpec& spec, const std::filesystem::path& path, Format format, const Metadata& metadata) {
    const Metadata with_digest = with_blank_digest(metadata);
    if (format == Format::exr || format == Format::png) {
        for (const auto& [name, value] : with_digest.entries())
            if (format == Format::exr || !needs_utf8_chunk(value)) spec.attribute(name, value);
        return;
    }
    const std::size_t size = pack(metadata).size();
    if (size > kMaxDescription)
        fail_to_write(path, fmt::format("{} bytes of metadata do not fit, at most {} do; .exr and .png hold more", size,
                                        kMaxDescription));
    spec.attribute("ImageDescription", pack(with_digest));
}

bool is_tiled(const PictureShape& shape, ExrLayout layout) {
    if (layout != ExrLayout::automatic) return layout == ExrLayout::tiles;
    return std::max(shape.width(), shape.height()) >= kTiledFrom;
}

void add_channels(OIIO::ImageSpec& spec, const std::vector<std::string>& names) {
    spec.channelformats.assign(3, spec.format);
    for (const std::string& name : names) {
        ++spec.nchannels;
        spec.channelnames.push_back(name);
        spec.channelformats.push_back(OIIO::TypeDesc::FLOAT);
    }
}

// What the numbers of an EXR mean.
void set_meaning(OIIO::ImageSpec& spec, const WriteOptions& options) {
    // x and y of red, green, blue and white: ITU-R BT.709, the primaries of sRGB.
    constexpr std::array<float, 8> kRec709{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, kRec709.size()), kRec709.data());
    for (const auto& [name, value] : options.exr_attributes) spec.attribute(name, value);
    if (!options.frames_per_second) return;
    const std::array<int, 2> rate{options.frames_per_second->numerator, options.frames_per_second->denominator};
    spec.attribute("framesPerSecond", OIIO::TypeRational, rate.data());
}

}  // namespace

OIIO::TypeDesc pixel_type(Format format, ExrFormat exr_format) {
    if (format == Format::exr) return exr_format == ExrFormat::half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
    return format == Format::tiff ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
}

OIIO::ImageSpec make_spec(const std::filesystem::path& path, Format format, const PictureShape& shape,
                          const Metadata& metadata, const WriteOptions& options) {
    OIIO::ImageSpec spec(shape.width(), shape.height(), 3, pixel_type(format, options.exr_format));
    const bool linear = format == Format::exr;
    if (linear && !options.exr_extra.empty()) add_channels(spec, options.exr_extra);
    const bool windows = linear || format == Format::tiff;
    if (windows) set_windows(spec, shape);
    if (windows) spec.attribute("compression", "zip");
    if (linear && is_tiled(shape, options.exr_layout)) spec.tile_width = spec.tile_height = kTileSide;
    if (format == Format::jpeg) {
        spec.attribute("compression", "jpeg:95");
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    // In a TIFF this would become an Exif directory, which OpenImageIO 2.4 writes over the picture's own.
    if (format != Format::tiff) spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
    // OpenImageIO dates EXR and TIFF files unless there is a DateTime; one that is no text is not written.
    if (windows) spec.attribute("DateTime", 0);
    if (linear) set_meaning(spec, options);
    set_metadata(spec, path, format, metadata);
    return spec;
}

}  // namespace strata::image
