#include "src/image/encode.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/image/digest.h"
#include "src/image/encoder.h"
#include "src/image/image_error.h"

namespace strata::image {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw ImageError(fmt::format("cannot write \"{}\": {}", path.string(), reason));
}

// write(encoder, rgb) writes a strip.
template <class Write>
std::vector<unsigned char> encode_with(const std::filesystem::path& path, const Picture& picture,
                                       const Metadata& metadata, const WriteOptions& options, const Write& write) {
    if (picture.rgb.size() != 3 * picture.pixels())
        fail(path,
             fmt::format("{} values do not make {}x{} pixels", picture.rgb.size(), picture.width(), picture.height()));
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    Encoder encoder(path, picture.shape(), metadata, options, memory);
    bytes.reserve(2 * picture.rgb.size());  // pictures rarely grow by compression; doubling would hold two copies
    const std::size_t row_values = 3 * static_cast<std::size_t>(picture.width());
    const std::span<const float> rgb(picture.rgb);
    for (std::size_t begin = 0; begin < rgb.size(); begin += kStripRows * row_values) {
        write(encoder, rgb.subspan(begin, std::min(kStripRows * row_values, rgb.size() - begin)));
    }
    encoder.finish();
    put_digest(format_of(path), bytes);
    tell_clipping(path, encoder, options);
    return bytes;
}

}  // namespace

std::vector<unsigned char> encode(const std::filesystem::path& path, const Picture& picture, const Metadata& metadata,
                                  const WriteOptions& options) {
    return encode_with(path, picture, metadata, options,
                       [](Encoder& encoder, std::span<const float> rgb) { encoder.write_linear(rgb); });
}

std::vector<unsigned char> encode_codes(const std::filesystem::path& path, const Picture& codes,
                                        const Metadata& metadata) {
    if (format_of(path) == Format::exr) fail(path, "an EXR holds linear radiance, no sRGB codes");
    return encode_with(path, codes, metadata, {},
                       [](Encoder& encoder, std::span<const float> rgb) { encoder.write_codes(rgb); });
}

}  // namespace strata::image
