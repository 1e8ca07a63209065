#include "src/scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "src/scene/scene_error.h"
#include "src/scene/typed_number.h"

namespace strata::scene {

namespace {

bool is_binary(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\r' && c != '\t') || byte == 0x7f;
}

bool continues_code_point(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

std::optional<Fault> find_binary(std::string_view text) {
    const auto found = std::find_if(text.begin(), text.end(), is_binary);
    if (found == text.end()) return std::nullopt;
    Fault fault;
    for (auto c = text.begin(); c != found; ++c) {
        if (*c == '\n') {
            ++fault.line;
            fault.column = 1;
        } else if (!continues_code_point(*c)) {
            ++fault.column;
        }
    }
    fault.message =
        fmt::format("not text (byte {:#04x}), allowed: a scene file in TOML", static_cast<unsigned char>(*found));
    return fault;
}

bool is_bare(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || c == '+';
}

// Whether the dot at i stands between digits, in a word without another dot.
bool is_decimal_point(std::string_view text, std::size_t i) {
    if (i == 0 || i + 1 == text.size() || !is_digit(text[i - 1]) || !is_digit(text[i + 1])) return false;
    std::size_t first = i, last = i;
    while (first > 0 && is_bare(text[first - 1])) --first;
    while (last + 1 < text.size() && is_bare(text[last + 1])) ++last;
    const bool dot_before = first > 0 && text[first - 1] == '.';
    const bool dot_after = last + 1 < text.size() && text[last + 1] == '.';
    return !dot_before && !dot_after;
}

std::ptrdiff_t count_dots(std::string_view text) {
    constexpr std::string_view kEntry = "[[camera.keys]]";
    std::ptrdiff_t dots = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool line_begins = i == 0 || text[i - 1] == '\n';
        if (line_begins && text.substr(i).starts_with(kEntry)) i += kEntry.size();
        if (i >= text.size() || text[i] != '.') continue;
        if (!is_decimal_point(text, i)) ++dots;
    }
    return dots;
}

}  // namespace

std::string file_text(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw SceneError(fmt::format("{}: no such file", path));
    if (std::filesystem::is_directory(status)) {
        throw SceneError(fmt::format("{}: a folder, allowed: a scene file in TOML", path));
    }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) throw SceneError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
    std::string text(kLargestFile + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) throw SceneError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

std::optional<Fault> find_unreadable(std::string_view text) {
    if (text.size() > kLargestFile) {
        return Fault{1, 1, fmt::format("too large, allowed: scene files up to {} bytes", kLargestFile)};
    }
    const std::ptrdiff_t dots = count_dots(text);
    if (dots > kMostDots) {
        return Fault{1, 1, fmt::format("too many full stops ({}), allowed: {} in a file", dots, kMostDots)};
    }
    return find_binary(text);
}

}  // namespace strata::scene
