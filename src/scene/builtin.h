// The scenes that come with the program: tools/scenes/*.toml, embedded when it is built (embed_scenes.cmake).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strata::scene {

struct BuiltinScene {
    std::string name;   // the file's, without .toml
    std::string title;  // one line
    std::string_view text;
};

// By name, a to z.
std::vector<BuiltinScene> builtin_scenes();

std::optional<BuiltinScene> find_builtin(std::string_view name);

struct BuiltinText {
    std::string_view name;
    std::string_view text;
};

// As generated at build time.
std::span<const BuiltinText> builtin_texts();

}  // namespace strata::scene
