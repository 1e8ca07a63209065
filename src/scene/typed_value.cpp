#include "src/scene/typed_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <variant>

#include "src/scene/key_text.h"
#include "src/scene/typed_number.h"

namespace strata::scene {

namespace {

bool has_control(std::string_view text) {
    return std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

// Text without quotes around it. A line break in it could begin a further key.
bool is_bare(std::string_view text) {
    return !text.empty() && text.front() != '"' && text.front() != '\'' && !has_control(text);
}

}  // namespace

std::string toml_of_typed(const Key& key, std::string_view typed) {
    if (std::holds_alternative<std::string*>(key.field)) return is_bare(typed) ? quoted(typed) : std::string(typed);
    const bool is_whole = std::holds_alternative<int*>(key.field) || std::holds_alternative<std::uint64_t*>(key.field);
    // The other spellings of an integer are TOML's own.
    if (is_whole && typed.find_first_of(".eE") != std::string_view::npos) {
        if (const auto integer = typed_integer<std::int64_t>(typed)) return fmt::format("{}", *integer);
    }
    return with_toml_numbers(typed);
}

bool is_bare_word(std::string_view text) {
    return is_bare(text) && std::isalpha(static_cast<unsigned char>(text.front())) != 0;
}

}  // namespace strata::scene
