#include "src/scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "src/scene/scene_error.h"

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
    const auto dots = std::count(text.begin(), text.end(), '.');
    if (dots > kMostDots) {
        return Fault{1, 1, fmt::format("too many full stops ({}), allowed: {} in a file", dots, kMostDots)};
    }
    return find_binary(text);
}

}  // namespace strata::scene
