// Surfaces of every kind, for tests that hold for all of them: a kind that is added to src/solid/all.h is tested by all
// that go through these.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "src/scene/scene.h"
#include "src/solid/solid.h"

namespace strata::support {

constexpr std::array<solid::Kind, solid::kKinds> all_kinds() {
    std::array<solid::Kind, solid::kKinds> kinds;
    for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = solid::all_solids()[i].kind;
    return kinds;
}

// The kind that a number falls on, for tests that count through them or draw one.
constexpr solid::Kind any_kind(std::uint64_t number) { return all_kinds()[number % solid::kKinds]; }

// Whether all that is solid lies in a ball, so that it can be seen from outside.
inline bool is_bounded(const scene::Surface& surface) {
    return solid::visit([&](const auto& s) { return std::isfinite(s.extent(surface.amplitude).ball); },
                        surface.solid());
}

// A picture of a few pixels: from the ground, or from outside.
inline scene::Scene small_scene(solid::Kind kind, int width, int height) {
    scene::Scene scene;
    scene.film = {.width = width, .height = height};
    scene.sampling.N = 2;
    scene.surface.kind = kind;
    scene.surface.octaves = 5;
    scene.surface.shape<solid::Sphere>().radius = 2.0;
    scene.surface.shape<solid::LevelSet>().bound_size = glm::dvec3(1.5);
    scene.camera = {.look_at = {0.3, 0.8, 1.0}, .far = 60.0};
    if (is_bounded(scene.surface)) {
        scene.camera = {.position = {0.5, 1.0, -6.0}, .look_at = glm::dvec3(0.0), .far = 60.0};
    }
    return scene;
}

}  // namespace strata::support
