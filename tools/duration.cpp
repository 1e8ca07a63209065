#include "tools/duration.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "src/scene/key_text.h"
#include "tools/errors.h"

namespace strata::tools {

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
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    const double unit_s = seconds_of_unit({rest, static_cast<std::size_t>(text.data() + text.size() - rest)});
    const double seconds = value * unit_s;
    if (error != std::errc() || !(seconds > 0) || seconds > kLongest_s) {
        throw UsageError(fmt::format("{} {}: allowed: a time above 0 such as 90s, 2m or 1.5h, at most 1000h", option,
                                     scene::excerpt(text)));
    }
    return seconds;
}

}  // namespace strata::tools
