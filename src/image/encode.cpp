#include "src/image/encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "src/image/image_error.h"
#include "src/image/library.h"
#include "src/image/openimageio.h"
#include "src/image/srgb.h"

namespace strata::image {
namespace {

constexpr float kMaxHalf = 65504.0f;

// A TIFF description is read back up to 65,536 bytes, a JPEG segment holds 65,533 with its own header inside.
constexpr std::size_t kMaxDescription = 60'000;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw ImageError(fmt::format("cannot write \"{}\": {}", path.string(), reason));
}

void check_shape(const std::filesystem::path& path, const Picture& p) {
    const bool inside =
        p.x0 >= 0 && p.y0 >= 0 && p.x0 < p.x1 && p.y0 < p.y1 && p.x1 <= p.frame_width && p.y1 <= p.frame_height;
    if (!inside)
        fail(path, fmt::format("the crop {},{},{},{} is empty or outside the {}x{} frame", p.x0, p.y0, p.x1, p.y1,
                               p.frame_width, p.frame_height));
    if (p.rgb.size() != 3 * p.pixels())
        fail(path, fmt::format("{} values do not make {}x{} pixels", p.rgb.size(), p.width(), p.height()));
    check_size(path, p.width(), p.height());
}

void check_finite(const std::filesystem::path& path, const Picture& picture) {
    std::size_t bad = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        const float* rgb = &picture.rgb[3 * i];
        if (std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2])) continue;
        if (bad++ == 0) first = i;
    }
    if (bad == 0) return;
    const auto width = static_cast<std::size_t>(picture.width());
    const float* rgb = &picture.rgb[3 * first];
    fail(path, fmt::format("{} pixel{} not finite, first ({},{}) = ({}, {}, {})", bad, bad == 1 ? " is" : "s are",
                           static_cast<std::size_t>(picture.x0) + first % width,
                           static_cast<std::size_t>(picture.y0) + first / width, rgb[0], rgb[1], rgb[2]));
}

// The nearest code of [0, max(Code)] after exposure and sRGB.
template <class Code>
std::vector<Code> quantise(std::span<const float> linear, double exposure) {
    constexpr double kTop = std::numeric_limits<Code>::max();
    // Beyond these limits every code is already 0 or the largest; within them no product is 0 * inf.
    const double scale = std::exp2(std::clamp(exposure, -1000.0, 1000.0));
    std::vector<Code> codes;
    codes.reserve(linear.size());
    for (const float value : linear) codes.push_back(static_cast<Code>(std::lround(encode_srgb(value * scale) * kTop)));
    return codes;
}

std::vector<float> clamp_to_half(std::span<const float> linear) {
    std::vector<float> clamped(linear.begin(), linear.end());
    for (float& value : clamped) value = std::clamp(value, -kMaxHalf, kMaxHalf);
    return clamped;
}

OIIO::TypeDesc pixel_type(Format format, ExrFormat exr_format) {
    if (format == Format::exr) return exr_format == ExrFormat::half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
    return format == Format::tiff ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
}

void set_windows(OIIO::ImageSpec& spec, const Picture& picture) {
    spec.x = picture.x0;
    spec.y = picture.y0;
    spec.full_width = picture.frame_width;
    spec.full_height = picture.frame_height;
}

void set_metadata(OIIO::ImageSpec& spec, const std::filesystem::path& path, Format format, const Metadata& metadata) {
    if (format == Format::exr || format == Format::png) {
        for (const auto& [name, value] : metadata.entries()) spec.attribute(name, value);
        return;
    }
    const std::string description = pack(metadata);
    if (description.size() > kMaxDescription)
        fail(path, fmt::format("{} bytes of metadata do not fit, at most {} do; .exr and .png hold more",
                               description.size(), kMaxDescription));
    if (!description.empty()) spec.attribute("ImageDescription", description);
}

OIIO::ImageSpec make_spec(const std::filesystem::path& path, Format format, const Picture& picture,
                          const Metadata& metadata, const WriteOptions& options) {
    OIIO::ImageSpec spec(picture.width(), picture.height(), 3, pixel_type(format, options.exr_format));
    const bool linear = format == Format::exr;
    const bool windows = linear || format == Format::tiff;
    if (windows) set_windows(spec, picture);
    if (windows) spec.attribute("compression", "zip");
    if (format == Format::jpeg) {
        spec.attribute("compression", "jpeg:95");
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    // In a TIFF this would become an Exif directory, which OpenImageIO 2.4 writes over the picture's own.
    if (format != Format::tiff) spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
    // OpenImageIO dates EXR and TIFF files unless there is a DateTime; one that is no text is not written.
    if (windows) spec.attribute("DateTime", 0);
    set_metadata(spec, path, format, metadata);
    return spec;
}

// Rows converted at once: a multiple of the 16 that EXR's zip packs together, and little memory beside the picture.
constexpr int kStripRows = 64;

// Writes the picture strip by strip through convert(linear values) -> a vector of what OpenImageIO is to be given.
template <class Convert>
bool write_strips(OIIO::ImageOutput& output, const Picture& picture, OIIO::TypeDesc type, const Convert& convert) {
    const std::span<const float> rgb(picture.rgb);
    const std::size_t row_values = 3 * static_cast<std::size_t>(picture.width());
    const int top = output.spec().y;
    for (int y = 0; y < picture.height(); y += kStripRows) {
        const int rows = std::min(kStripRows, picture.height() - y);
        const auto strip =
            convert(rgb.subspan(static_cast<std::size_t>(y) * row_values, static_cast<std::size_t>(rows) * row_values));
        if (!output.write_scanlines(top + y, top + y + rows, 0, type, strip.data())) return false;
    }
    return true;
}

// The nearest code of [0, max(Code)] to values that are codes of [0,1].
template <class Code>
std::vector<Code> round_codes(std::span<const float> values) {
    constexpr double kTop = std::numeric_limits<Code>::max();
    std::vector<Code> codes;
    codes.reserve(values.size());
    for (const float v : values) codes.push_back(static_cast<Code>(std::lround(std::clamp<double>(v, 0, 1) * kTop)));
    return codes;
}

bool write_codes(OIIO::ImageOutput& output, Format format, const Picture& codes) {
    if (format == Format::tiff) return write_strips(output, codes, OIIO::TypeDesc::UINT16, round_codes<std::uint16_t>);
    return write_strips(output, codes, OIIO::TypeDesc::UINT8, round_codes<std::uint8_t>);
}

bool write_linear(OIIO::ImageOutput& output, Format format, const Picture& picture, const WriteOptions& options) {
    const double exposure = options.exposure;
    switch (format) {
        case Format::exr:
            if (options.exr_format == ExrFormat::half)
                return write_strips(output, picture, OIIO::TypeDesc::FLOAT, clamp_to_half);
            return write_strips(output, picture, OIIO::TypeDesc::FLOAT, [](std::span<const float> v) { return v; });
        case Format::tiff:
            return write_strips(output, picture, OIIO::TypeDesc::UINT16,
                                [&](std::span<const float> v) { return quantise<std::uint16_t>(v, exposure); });
        case Format::png:
        case Format::jpeg:
            break;
    }
    return write_strips(output, picture, OIIO::TypeDesc::UINT8,
                        [&](std::span<const float> v) { return quantise<std::uint8_t>(v, exposure); });
}

// write_pixels(output, format) gives OpenImageIO the picture.
template <class WritePixels>
std::vector<unsigned char> encode_with(const std::filesystem::path& path, const Picture& picture,
                                       const Metadata& metadata, const WriteOptions& options,
                                       const WritePixels& write_pixels) {
    const Format format = format_of(path);
    check_shape(path, picture);
    check_finite(path, picture);
    if (!std::isfinite(options.exposure)) fail(path, fmt::format("an exposure of {} stops", options.exposure));

    configure_library();
    // All that can be wrong is found before the encoder exists: libjpeg ends the process when one is abandoned.
    const OIIO::ImageSpec spec = make_spec(path, format, picture, metadata, options);
    std::vector<unsigned char> bytes;
    bytes.reserve(spec.image_bytes());  // pictures rarely grow by compression; doubling would hold two copies at once
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name_of(format));
    if (!output) fail(path, OIIO::geterror());
    if (!output->set_ioproxy(&memory)) fail(path, "OpenImageIO cannot encode this format in memory");

    if (!output->open(name_of(format), spec) || !write_pixels(*output, format) || !output->close())
        fail(path, output->geterror());
    return bytes;
}

}  // namespace

std::vector<unsigned char> encode(const std::filesystem::path& path, const Picture& picture, const Metadata& metadata,
                                  const WriteOptions& options) {
    return encode_with(path, picture, metadata, options, [&](OIIO::ImageOutput& output, Format format) {
        return write_linear(output, format, picture, options);
    });
}

std::vector<unsigned char> encode_codes(const std::filesystem::path& path, const Picture& codes,
                                        const Metadata& metadata) {
    if (format_of(path) == Format::exr) fail(path, "an EXR holds linear radiance, no sRGB codes");
    return encode_with(path, codes, metadata, {},
                       [&](OIIO::ImageOutput& output, Format format) { return write_codes(output, format, codes); });
}

}  // namespace strata::image
