#include "tools/cli/duration.h"

#include <fmt/format.h>

#include <string_view>

#include "src/scene/key_text.h"
#include "src/scene/typed_number.h"
#include "tools/cli/errors.h"

namespace strata::tools::cli {

namespace {

constexpr double kLongest_s = 1000 * 3600.0;

// 0 for what is no unit.
double seconds_of_unit(std::string_view unit) {
    if (unit.empty() || unit == "s") return 1;
    if (unit == "m" || unit == "min") return 60;
    if (unit == "h") return 3600;
    return 0;
}

}  // namespace

double parse_duration(const char* option, const std::string& text) {
    const std::size_t digits = text.find_last_of("0123456789.") + 1;  // 0 if there is none
    const auto value = scene::typed_number(std::string_view(text).substr(0, digits));
    const double seconds = value.value_or(0) * seconds_of_unit(std::string_view(text).substr(digits));
    if (!(seconds > 0) || seconds > kLongest_s) {
        throw UsageError(fmt::format("{} {}: allowed: a time above 0 such as 90s, 2m or 1.5h, at most 1000h", option,
                                     scene::excerpt(text)));
    }
    return seconds;
}

}  // namespace strata::tools::cli
