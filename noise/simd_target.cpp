#include "noise/simd_target.h"

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <array>
#include <cstdint>
#include <utility>

namespace strata::noise {

namespace {

constexpr std::array<std::pair<std::int64_t, const char*>, 4> kNames = {
    {{HWY_AVX3, "avx512"}, {HWY_AVX2, "avx2"}, {HWY_SSE4, "sse4"}, {HWY_SCALAR, "scalar"}}};

// What this machine runs of what the program holds; asked once, before any pin hides the rest.
std::int64_t available() {
    static const std::int64_t targets = (hwy::SupportedTargets() & HWY_TARGETS) | HWY_STATIC_TARGET;
    return targets;
}

std::int64_t& pinned() {
    static std::int64_t target = 0;  // 0: none
    return target;
}

}  // namespace

std::vector<std::string> simd_targets() {
    std::vector<std::string> names;
    for (const auto& [target, name] : kNames) {
        if (available() & target) names.emplace_back(name);
    }
    return names;
}

std::string simd_target() {
    for (const auto& [target, name] : kNames) {
        if (available() & (pinned() ? pinned() : available()) & target) return name;
    }
    return "unknown";
}

bool pin_simd_target(const std::string& name) {
    for (const auto& [target, known] : kNames) {
        if (name != known || !(available() & target)) continue;
        pinned() = target;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        return true;
    }
    return false;
}

}  // namespace strata::noise
