// What is demanded of every scene that is accepted.
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "src/scene/printer.h"
#include "src/scene/scene_error.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"

namespace strata::fuzz {

// Printing takes ten times as long as reading: it is tried for inputs of some lengths.
inline bool is_printed(std::size_t size) { return size % 16 == 0; }

// Printed and read back it is the same scene. One that validate() refuses is none.
inline void check_scene(const scene::Scene& scene, std::size_t input_size) {
    scene::validate(scene, "fuzzed");
    if (!is_printed(input_size)) return;
    const std::string printed = scene::print_scene(scene, scene::PrintedKeys::all);
    try {
        if (scene::print_scene(scene::read_scene(printed, "printed"), scene::PrintedKeys::all) == printed) return;
        std::fprintf(stderr, "prints otherwise when it is read back:\n%s", printed.c_str());
    } catch (const scene::SceneError& error) {
        std::fprintf(stderr, "%s\nis refused when it is read back:\n%s", error.what(), printed.c_str());
    }
    std::abort();
}

}  // namespace strata::fuzz
