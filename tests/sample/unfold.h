// What folded numbers (src/sample/strata.h) stand for.
#pragma once

#include <cmath>

namespace strata::sample::test {

// y of [0,1), without the precision that folding keeps near 1.
inline double unfold(float q) { return std::signbit(q) ? static_cast<double>(-q) : 1.0 - static_cast<double>(q); }

}  // namespace strata::sample::test
