// Scene texts with a fault, and what is said of them.
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"

namespace strata::scene {

inline std::string refusal(const std::string& text) {
    try {
        validate(read_scene(text, "file"), "");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "accepted";
}

inline std::string with(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace strata::scene
