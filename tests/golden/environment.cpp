#include "tests/golden/environment.h"

#include <fmt/format.h>
#include <gnu/libc-version.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "tests/golden/digest.h"

namespace strata::golden {

namespace {

constexpr int kArguments = 4000;

std::string compiler() {
#ifdef __clang__
    return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
    return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

// The functions that pictures go through. Their last bits differ between implementations at some per cent of the
// arguments, so that thousands of arguments tell any two apart.
std::string libm_digest() {
    std::vector<double> values;
    volatile double start = 0.001;  // keeps the compiler from computing the values itself
    double x = start;
    for (int i = 0; i < kArguments; ++i, x += 0.0007) {
        const double unit = x / 3.0;
        const std::array results{std::sin(x),       std::cos(x),         std::tan(x),        std::asin(unit),
                                 std::acos(unit),   std::atan(x),        std::exp(-x),       std::exp2(x),
                                 std::expm1(-x),    std::log(x),         std::log2(x),       std::cbrt(x),
                                 std::pow(x, unit), std::hypot(x, unit), std::atan2(unit, x)};
        values.insert(values.end(), results.begin(), results.end());
    }
    return digest_text(std::span<const double>(values));
}

}  // namespace

Environment this_environment() { return {compiler(), libm_digest(), fmt::format("glibc {}", gnu_get_libc_version())}; }

std::string what_differs(const Environment& pinned, const Environment& here) {
    std::string words;
    if (pinned.compiler != here.compiler) {
        words = fmt::format("compiled by {}, pinned by {}", here.compiler, pinned.compiler);
    }
    if (pinned.libm != here.libm) {
        words += fmt::format("{}the maths functions of {} on this processor return other bits than those of {} did",
                             words.empty() ? "" : "; ", here.libc, pinned.libc);
    }
    return words;
}

}  // namespace strata::golden
