#include "src/scene/validate.h"

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <string>

#include "src/scene/key_text.h"
#include "src/scene/keys.h"

namespace strata::scene {

namespace {

void check_fields(Scene scene) {
    for (const Section& section : describe(scene)) {
        for (const Key& key : section.keys) {
            if (const auto problem = field_problem(key)) throw SceneError(complaint(key, *problem, value_text(key)));
        }
    }
}

std::string point_text(const glm::dvec3& p) {
    return fmt::format("[{}, {}, {}]", number_text(p.x), number_text(p.y), number_text(p.z));
}

void check_view(const Camera& camera) {
    if (glm::distance(camera.position, camera.look_at) >= kShortestDirection) return;
    throw SceneError(fmt::format("camera.look_at: is the same point as camera.position ({}), allowed: any other point",
                                 point_text(camera.look_at)));
}

void check_octaves(const Scene& scene) {
    const Surface& surface = scene.surface;
    const double farthest = reach(scene);
    double amplitude = surface.amplitude;
    double frequency = surface.frequency;
    for (int k = 0; k < surface.octaves && amplitude != 0.0; ++k) {
        if (!(frequency * farthest <= kMostCells)) {
            const std::string octaves =
                k > 0 ? fmt::format("surface.octaves up to {}, or a lower surface.lacunarity, ", k)
                      : std::string("a lower ");
            const bool bounded = surface.kind == SurfaceKind::isosurface;
            throw SceneError(
                fmt::format("surface.octaves: octave {} of {} is too fine for double precision ({:.3g} lattice cells a "
                            "surface unit, "
                            "seen up to {:.3g} surface units from surface.origin, exceed 2^50 cells), allowed: "
                            "{}surface.frequency or "
                            "{}",
                            k + 1, surface.octaves, frequency, farthest, octaves,
                            bounded ? "surface.bound_size" : "camera.far, or a camera nearer to surface.origin"));
        }
        amplitude *= surface.gain;
        frequency *= surface.lacunarity;
    }
}

}  // namespace

double reach(const Scene& scene) {
    const Surface& surface = scene.surface;
    if (surface.kind == SurfaceKind::isosurface) {
        return surface.bound == BoundKind::ball ? surface.bound_size.x : glm::length(surface.bound_size);
    }
    const double along_rays = (glm::distance(scene.camera.position, surface.origin) + scene.camera.far) / surface.scale;
    return surface.kind == SurfaceKind::planet ? along_rays + surface.radius : along_rays;
}

void validate(const Scene& scene, std::string_view source_name) {
    try {
        check_fields(scene);
        if (scene.image == ImageKind::surface) {
            check_view(scene.camera);
            check_octaves(scene);
        }
    } catch (const SceneError& error) {
        if (source_name.empty()) throw;
        throw SceneError(fmt::format("{}: {}", source_name, error.what()));
    }
}

}  // namespace strata::scene
