// A scene file's text before TOML sees it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace strata::scene {

// Larger files are refused: scenes are a few kilobytes, or two megabytes with as many camera keys as there may be.
inline constexpr std::size_t kLargestFile = 1 << 22;

// toml++ destroys nested tables recursively, and a dotted name a.a.a... nests without limit. Each dot nests once at
// most, so this many cannot exhaust the stack. Decimal points do not count, nor do lines that begin an entry of
// camera.keys; a dotted name that is written to look like numbers still has every second dot counted.
inline constexpr std::ptrdiff_t kMostDots = 4000;

// An error and where it is: line and column (in code points) from 1.
struct Fault {
    std::size_t line = 1;
    std::size_t column = 1;
    std::string message;
};

// The text of a file, cut one byte after kLargestFile. SceneError for what is missing, a folder or unreadable.
std::string file_text(const std::string& path);

// What makes text no scene file, whatever it says: size, dots, bytes that no text holds.
std::optional<Fault> find_unreadable(std::string_view text);

}  // namespace strata::scene
