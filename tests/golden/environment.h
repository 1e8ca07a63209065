// What bits depend on besides the sources and the SIMD target.
#pragma once

#include <string>

namespace strata::golden {

struct Environment {
    std::string compiler;  // "g++ 12.2.0"
    std::string libm;      // digest of what its functions return: glibc picks other code for other processors
    std::string libc;      // "glibc 2.36": to be read by people, not compared
};

Environment this_environment();

// Empty where pictures of both must have the same bits; else what differs, in words.
std::string what_differs(const Environment& pinned, const Environment& here);

}  // namespace strata::golden
