// Numbers as people read them.
#pragma once

#include <string>

namespace strata::tools::report {

// A count with three digits: 12345678 -> "12.3 M".
std::string scaled(double count);

}  // namespace strata::tools::report
