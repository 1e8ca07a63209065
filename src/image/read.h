// Pictures back from files: EXR, PNG, TIFF and JPEG, told apart by their first bytes whatever they are called.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "src/image/colour_out.h"
#include "src/image/digest.h"
#include "src/image/metadata.h"
#include "src/image/picture.h"

namespace strata::image {

// Whether the file starts like a picture of a known format. False for what cannot be read.
bool is_picture(const std::filesystem::path& path);

// What a file says of itself.
struct PictureFacts {
    PictureShape shape;  // as of read_picture()
    Metadata metadata;   // without the digest
    Integrity integrity = Integrity::unknown;
};

// Reads all bytes and decodes no pixel. Throws ImageError for what is no picture.
PictureFacts read_facts(const std::filesystem::path& path);

// Throws as read_picture() for a picture that is damaged by its digest or what its format tells without decoding:
// before its metadata are believed.
void refuse_damaged(const std::filesystem::path& path);

// The channels R, G and B, or grey three times; alpha is left out. Values are as stored: codes scaled to [0,1] where
// they are whole numbers. Frame and crop come from EXR and TIFF; elsewhere the picture is its own frame. A frame that
// does not start at (0,0) is moved there. Throws ImageError for what is no picture, has neither grey nor RGB or is
// damaged: by its digest (digest.h) or, where it has none, as far as its format tells.
Picture read_picture(const std::filesystem::path& path);

// Linear radiance, with alpha that of the picture over black. EXR, and TIFF in floating point, are as stored, NaN and
// infinity included. Codes, sRGB's unless the file says otherwise (light.h), are decoded, with the exposure and the
// white balance undone that they were written with, unless they are linear; what they clipped to 1 stays there. Throws
// as read_picture(), for video's codes of high dynamic range, and for codes that were written with what cannot be
// undone, a tone curve or a saturation (obstacle_to_light()).
Picture read_linear(const std::filesystem::path& path, const ColourOut& written_with = {});

// A metadata entry as it was written, or nothing when the picture has none of that name. Throws ImageError for what is
// no picture.
std::optional<std::string> read_metadata(const std::filesystem::path& path, std::string_view name);

}  // namespace strata::image
