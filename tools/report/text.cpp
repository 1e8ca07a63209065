#include "tools/report/text.h"

#include <fmt/format.h>

#include <utility>

namespace strata::tools::report {

std::string scaled(double count) {
    constexpr std::pair<double, const char*> kScales[] = {{1e12, " T"}, {1e9, " G"}, {1e6, " M"}, {1e3, " k"}};
    for (const auto& [scale, letter] : kScales) {
        if (count >= 10 * scale || (scale > 1e3 && count >= scale)) {
            const double value = count / scale;
            return fmt::format("{:.{}f}{}", value, value < 10 ? 2 : value < 100 ? 1 : 0, letter);
        }
    }
    return fmt::format("{:.0f}", count);
}

}  // namespace strata::tools::report
