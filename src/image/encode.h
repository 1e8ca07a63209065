// A picture as the bytes of a file, made in memory: the same bytes for the same arguments, always.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "src/image/colour_out.h"
#include "src/image/format.h"
#include "src/image/metadata.h"
#include "src/image/picture.h"

namespace strata::image {

enum class ExrFormat { half, floating };

// automatic: tiles where the crop has kTiledFrom pixels or more on either side.
enum class ExrLayout { automatic, scanlines, tiles };
inline constexpr int kTiledFrom = 4096;

// numerator / denominator frames a second, both positive.
struct FrameRate {
    int numerator = 25, denominator = 1;
    bool operator==(const FrameRate&) const = default;
};

struct WriteOptions {
    ColourOut colour{};  // EXR ignores it and stays linear
    ExrFormat exr_format = ExrFormat::half;
    ExrLayout exr_layout = ExrLayout::automatic;
    std::vector<std::string> exr_extra{};  // channels of 32 bits beside R, G and B, as "steps.Y"; of streams alone
    std::vector<std::pair<std::string, std::string>> exr_attributes{};  // of the header, for who reads those channels
    std::optional<FrameRate> frames_per_second{};    // that an EXR says, where it is a frame of an animation
    bool keeps_not_finite = false;                   // in an EXR in floating point: of a picture of another program
    std::function<void(const std::string&)> warn{};  // of what a whole file lost: radiance beyond the largest half
};

// Is given the codes that a strip of rows has become in a PNG, JPEG (bytes) or TIFF (numbers of 16 bits, in the
// machine's order), three a pixel, before they are written, and may change them. Not called for a strip that is not
// finite.
using CodesHook = std::function<void(std::span<unsigned char> codes)>;

// Rows encoded at once: a multiple of the 16 that EXR's zip packs together and of the 64 of its tiles, and little
// memory beside a whole picture.
inline constexpr int kStripRows = 64;

// Throws ImageError for all that would keep a picture of this shape from being encoded, whatever its pixels are: the
// limits of the format, windows, metadata, options. For before the work. Only the extension of `path` is used.
void check_encodable(const std::filesystem::path& path, const PictureShape& shape, const Metadata& metadata,
                     const WriteOptions& options);

// EXR: linear, zip, in scanlines or tiles of 64x64; TIFF: 16 bits, zip; PNG: 8 bits; JPEG: 8 bits, quality 95, no
// chroma subsampling. The last three get the colours of colour_out.h, are clamped and passed through sRGB's transfer
// function; 16 bits are rounded to the nearest code, 8 are dithered by the pixel's place in the frame (dither.h). EXR
// and TIFF keep the crop as data window and the frame as display window; PNG and JPEG hold the crop alone. Finite
// radiance beyond the largest half (65504) becomes that. EXR and PNG carry each metadata entry under its name, TIFF and
// JPEG all of them packed into the image description; a digest of the file's bytes (digest.h) is one of them. Throws
// ImageError, which names `path`, for NaN or infinite pixels, for metadata too long for the format (60,000 bytes in
// TIFF and JPEG) and for a picture that breaks its own rules. Only the extension and the name of `path` are used.
std::vector<unsigned char> encode(const std::filesystem::path& path, const Picture& picture, const Metadata& metadata,
                                  const WriteOptions& options);

// The same for a picture whose values are sRGB codes in [0,1] already: rounded to the format's codes, nothing else.
// Throws ImageError for EXR too.
std::vector<unsigned char> encode_codes(const std::filesystem::path& path, const Picture& codes,
                                        const Metadata& metadata);

}  // namespace strata::image
