#include "noise/simd_target.h"

#include "src/noise.h"

namespace strata {

std::vector<std::string> simd_targets() { return noise::simd_targets(); }

std::string simd_target() { return noise::simd_target(); }

void use_simd_target(std::string_view name) {
    if (noise::pin_simd_target(std::string(name))) return;
    std::string allowed;
    for (const std::string& target : simd_targets()) allowed += (allowed.empty() ? "" : ", ") + target;
    throw Error("SIMD target '" + std::string(name) + "': not on this machine, allowed: " + allowed);
}

}  // namespace strata
