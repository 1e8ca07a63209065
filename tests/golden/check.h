// Golden scenes held against their pins, and pins made anew.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "tests/golden/scenes.h"

namespace strata::golden {

struct Folders {
    std::filesystem::path pins;  // TARGET.toml, and pictures/SCENE.txt
    std::filesystem::path left;  // where pictures of what differs are left: TARGET/SCENE/
};

std::filesystem::path pins_path(const Folders& folders, const std::string& target);

enum class Verdict { same, differs, differs_elsewhere };

// Prints what differs on the SIMD target in use, whose name is `target`. differs_elsewhere: something does, but the
// pins were made by another compiler or maths library, which explains it.
Verdict check(const std::string& target, std::span<const GoldenScene> scenes, const Folders& folders);

// Prints what differs, then replaces the target's pins, and its pictures if they are the expected ones.
void pin(const std::string& target, std::span<const GoldenScene> scenes, const Folders& folders);

}  // namespace strata::golden
