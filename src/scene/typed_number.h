// Numbers as people type them on a command line: `.5`, `5.`, `+1` and `1e3`, where TOML and std::from_chars each refuse
// some of these.
#pragma once

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace strata::scene {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }  // in every locale

// A decimal number that fills the whole text. Nothing for what is no number, is not finite or beyond double; the point
// is a point in every locale.
std::optional<double> typed_number(std::string_view text);

// A whole number that fills the text, "1e3" included. Nothing beyond the type's range, or where only rounding makes it
// whole.
template <class Integer>
std::optional<Integer> typed_integer(std::string_view text) {
    const std::string_view digits = text.substr(text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
    Integer integer{};
    const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), integer);
    if (error == std::errc() && rest == digits.data() + digits.size()) return integer;
    constexpr double kExact = 9007199254740992.0;  // 2^53: beyond it a double skips whole numbers
    const auto number = typed_number(text);
    if (!number || std::trunc(*number) != *number || std::fabs(*number) > kExact) return std::nullopt;
    using Limits = std::numeric_limits<Integer>;
    if (*number < static_cast<double>(Limits::min()) || *number > static_cast<double>(Limits::max())) {
        return std::nullopt;
    }
    return static_cast<Integer>(*number);
}

// A TOML value with the numbers outside its quotes spelt as TOML wants them: `[.5, 1.]` becomes `[0.5, 1.0]`.
std::string with_toml_numbers(std::string_view value);

}  // namespace strata::scene
