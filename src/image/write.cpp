#include "src/image/write.h"

#include "src/image/output_file.h"

namespace strata::image {

void write_picture(const std::filesystem::path& path, const Picture& picture, const Metadata& metadata,
                   const WriteOptions& options) {
    replace_file(path, encode(path, picture, metadata, options));
}

}  // namespace strata::image
