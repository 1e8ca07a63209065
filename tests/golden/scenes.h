// Tiny scenes that between them go through all that a picture can be made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/integrate/make_image.h"
#include "src/scene/scene.h"

namespace strata::golden {

struct GoldenScene {
    std::string name;
    std::vector<std::string> keys;        // as for --set, over the defaults: keys outlive the structs that hold them
    int passes = 1;                       // of N x N samples
    std::optional<film::Rect> crop{};     // half-open; nothing: the whole frame
    std::vector<std::string> channels{};  // of each pixel as well
    integrate::Tracer tracer = integrate::Tracer::fast;
    std::string
        relief{};  // [[relief]] terms or other lists, as in a scene file; no terms: the sum of octaves of the keys
};

// Their names differ and name files.
std::vector<GoldenScene> golden_scenes();

// Throws scene::SceneError for a key that is unknown or out of range.
scene::Scene scene_of(const GoldenScene& golden);

}  // namespace strata::golden
