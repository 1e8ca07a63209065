#include "src/image/image_error.h"

#include <fmt/format.h>

#include <system_error>

namespace strata::image {

void fail_to_read(const std::filesystem::path& path, const std::string& reason) {
    throw ImageError(fmt::format("cannot read \"{}\": {}", path.string(), reason));
}

void fail_to_write(const std::filesystem::path& path, const std::string& reason) {
    throw ImageError(fmt::format("cannot write \"{}\": {}", path.string(), reason));
}

std::string system_reason(int error) { return std::generic_category().message(error); }

}  // namespace strata::image
