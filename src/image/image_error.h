#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace strata::image {

// A picture that cannot be written or read. what() names the file, the reason and, where there is one, the way out.
class ImageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

[[noreturn]] void fail_to_read(const std::filesystem::path& path, const std::string& reason);
[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& reason);

// As the system words errno.
std::string system_reason(int error);

}  // namespace strata::image
