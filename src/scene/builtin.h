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

// What is rendered where no scene is named.
inline constexpr std::string_view kDefaultScene = "alpenglow";

// By name, a to z.
std::vector<BuiltinScene> builtin_scenes();

// `terrain`, the kind of surface that most scenes have, is another name of `hills`, the plainest of them.
std::optional<BuiltinScene> find_builtin(std::string_view name);

struct BuiltinText {
    std::string_view name;
    std::string_view text;
};

// As generated at build time.
std::span<const BuiltinText> builtin_texts();

}  // namespace strata::scene
