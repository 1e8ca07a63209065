#include "src/scene/typed_number.h"

#include <algorithm>

namespace strata::scene {

namespace {

std::string_view without_sign(std::string_view text) {
    return text.substr(!text.empty() && (text.front() == '+' || text.front() == '-') ? 1 : 0);
}

std::size_t count_digits(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) - text.begin());
}

// The parts of [sign] digits [. digits] [e [sign] digits], with digits on one side of the point at least.
struct Parts {
    std::string_view sign, whole, fraction, exponent;  // exponent: with its 'e'
    bool has_point = false;
};

std::optional<Parts> parts_of(std::string_view text) {
    Parts parts;
    std::string_view rest = without_sign(text);
    parts.sign = text.substr(0, text.size() - rest.size());
    parts.whole = rest.substr(0, count_digits(rest));
    rest.remove_prefix(parts.whole.size());
    if (rest.starts_with('.')) {
        parts.has_point = true;
        rest.remove_prefix(1);
        parts.fraction = rest.substr(0, count_digits(rest));
        rest.remove_prefix(parts.fraction.size());
    }
    if (parts.whole.empty() && parts.fraction.empty()) return std::nullopt;
    if (rest.empty()) return parts;
    if (rest.front() != 'e' && rest.front() != 'E') return std::nullopt;
    const std::string_view digits = without_sign(rest.substr(1));
    if (digits.empty() || count_digits(digits) != digits.size()) return std::nullopt;
    parts.exponent = rest;
    return parts;
}

bool is_word(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.' || c == '+' ||
           c == '-' || c == ':';
}

std::string toml_number(std::string_view word) {
    const auto parts = parts_of(word);
    if (!parts || !parts->has_point) return std::string(word);
    std::string text(parts->sign);
    text += parts->whole.empty() ? "0" : parts->whole;
    text += '.';
    text += parts->fraction.empty() ? "0" : parts->fraction;
    text += parts->exponent;
    return text;
}

// Where the string ends whose opening quote is at `begin`, after its closing quote.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    std::size_t i = begin + 1;
    while (i < text.size() && text[i] != quote) i += quote == '"' && text[i] == '\\' ? 2 : 1;
    return std::min(i + 1, text.size());
}

}  // namespace

std::optional<double> typed_number(std::string_view text) {
    if (!parts_of(text)) return std::nullopt;
    if (text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) {
        // Too small is as good as 0 to whoever typed it; too large is not.
        const std::string_view exponent = parts_of(text)->exponent;
        if (exponent.size() > 1 && exponent[1] == '-') return text.front() == '-' ? -0.0 : 0.0;
        return std::nullopt;
    }
    if (error != std::errc() || rest != text.data() + text.size()) return std::nullopt;
    return value;
}

std::string with_toml_numbers(std::string_view value) {
    std::string result;
    for (std::size_t i = 0; i < value.size();) {
        std::size_t end = i + 1;
        if (value[i] == '"' || value[i] == '\'') {
            end = end_of_string(value, i);
            result += value.substr(i, end - i);
        } else if (is_word(value[i])) {
            while (end < value.size() && is_word(value[end])) ++end;
            result += toml_number(value.substr(i, end - i));
        } else {
            result += value[i];
        }
        i = end;
    }
    return result;
}

}  // namespace strata::scene
