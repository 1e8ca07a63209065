// The head of a picture file, as OpenImageIO takes it. Private to src/image.
#pragma once

#include <filesystem>

#include "src/image/encode.h"
#include "src/image/format.h"
#include "src/image/openimageio.h"

namespace strata::image {

// Of R, G and B.
OIIO::TypeDesc pixel_type(Format format, ExrFormat exr_format);

// With the metadata and a blank digest, but for what a PNG holds as UTF-8 (png_text.h). Throws ImageError, naming
// `path`, for more metadata than fit.
OIIO::ImageSpec make_spec(const std::filesystem::path& path, Format format, const PictureShape& shape,
                          const Metadata& metadata, const WriteOptions& options);

}  // namespace strata::image
