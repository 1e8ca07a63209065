// Which SIMD instructions the program uses. Without a choice, Highway takes the best that the machine has.
#pragma once

#include <string>
#include <vector>

namespace strata::noise {

// Names of the targets that this program holds and this machine can run, best first: avx512, avx2, sse4, scalar.
std::vector<std::string> simd_targets();

// The target in use. Pictures are the same to the bit on one target; across targets they differ by rounding.
std::string simd_target();

// Uses one target from now on, in the whole program. False, and nothing changes, for a name not in simd_targets().
bool pin_simd_target(const std::string& name);

}  // namespace strata::noise
