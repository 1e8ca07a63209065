#pragma once

#include <filesystem>

#include "src/image/encode.h"

namespace strata::image {

// Encodes (encode.h) and puts the file in place whole (output_file.h). Throws ImageError.
void write_picture(const std::filesystem::path& path, const Picture& picture, const Metadata& metadata = {},
                   const WriteOptions& options = {});

}  // namespace strata::image
