#pragma once

#include <stdexcept>

namespace strata::image {

// A picture that cannot be written or read. what() names the file, the reason and, where there is one, the way out.
class ImageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace strata::image
