// The one exception of the library.
//
// Everything that Strata refuses or cannot do - a scene or key that is wrong, a value out of range, a file that cannot
// be read or written, memory for a picture that is not there - is a strata::Error. what() is one line for people: the
// place first (a file with line and column, a key, a parameter, a path), then what is wrong there, then what is
// allowed. Nothing else is thrown, but for std::bad_alloc where there is no memory for a few words, and for what a
// caller's own callbacks throw, which passes through as it is.
//
//     hills.toml:3:11: camera.fov_deg: out of range (400.0), allowed: 0.01 to 179 degrees
#pragma once

#include <stdexcept>

namespace strata {

class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace strata
