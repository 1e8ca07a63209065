// The chunks of a PNG (ISO/IEC 15948) that OpenImageIO does not read or write: what a file says of its colours by cICP,
// and text beyond Latin-1, which belongs into iTXt.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace strata::image {

// The signature and IHDR, which begin every PNG; other chunks may follow.
inline constexpr std::size_t kPngStart = 8 + 4 + 4 + 13 + 4;

// The data of the first chunk of this type before the pixels, or nothing. For short chunks: nothing for one above 64
// KB.
std::optional<std::string> find_png_chunk(const std::filesystem::path& png, std::string_view type);

// A whole chunk: length, type, data and checksum.
std::string png_chunk(std::string_view type, std::string_view data);

// Whether a text is for iTXt: it is UTF-8 and not plain ASCII. Bytes that are no UTF-8 stay in a tEXt, as they are.
bool needs_utf8_chunk(std::string_view text);

// An iTXt chunk, not compressed. Neither the keyword nor the text holds a NUL.
std::string utf8_text_chunk(std::string_view keyword, std::string_view text);

}  // namespace strata::image
