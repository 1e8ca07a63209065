#include "src/scene/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <stdexcept>
#include <string>

#include "src/scene/camera_path.h"
#include "src/scene/cloud_keys.h"
#include "src/scene/ground_keys.h"
#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/needs.h"
#include "src/scene/relief_keys.h"
#include "src/scene/water_keys.h"

namespace strata::scene {

namespace {

void check_keys(const Section& section) {
    for (const Key& key : section.keys) {
        if (const auto problem = field_problem(key)) {
            throw SceneError(complaint(key, *problem, excerpt(value_text(key))));
        }
    }
}

void check_fields(Scene scene) {
    for (const Section& section : describe(scene)) check_keys(section);
    for (std::size_t i = 0; i < scene.camera.keys.size(); ++i) {
        CameraKey& entry = scene.camera.keys[i];
        check_keys(describe_camera_key(entry, scene.camera, i));
    }
}

// Daylight is that of level ground under the Earth's air, and its sun does not go round.
void check_daylight(const Scene& scene) {
    if (scene.sky.model != SkyModel::daylight) return;
    const solid::KindRow& kind = solid::row_of(scene.surface.kind);
    if (!kind.is_level) {
        throw SceneError(fmt::format(
            "sky.model: \"daylight\" has its horizon level, a {} has not, allowed: \"gradient\" here", kind.name));
    }
    if (scene.surface.spin_deg_per_s != 0.0) {
        throw SceneError(
            "sky.model: \"daylight\" stands still over a surface that does not, allowed: surface.spin_deg_per_s = 0, "
            "or \"gradient\"");
    }
}

// The same is true of fog, whose level is a height.
void check_fog(const Scene& scene) {
    if (scene.fog.visibility_m <= 0.0) return;
    const solid::KindRow& kind = solid::row_of(scene.surface.kind);
    if (!kind.is_level) {
        throw SceneError(fmt::format("fog.visibility_m: fog lies level, a {} does not, allowed: 0 here", kind.name));
    }
    if (scene.surface.spin_deg_per_s != 0.0) {
        throw SceneError(
            "fog.visibility_m: fog stands still over a surface that does not, allowed: surface.spin_deg_per_s = 0, or "
            "0 here");
    }
}

void check_relief(const Scene& scene) {
    const auto& terms = scene.surface.relief;
    if (terms.size() > kMostReliefTerms) {
        throw SceneError(fmt::format("relief: {} terms, allowed: {} at most", terms.size(), kMostReliefTerms));
    }
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (const std::string problem = relief_problem(terms, i); !problem.empty()) throw SceneError(problem);
        if (solid::row_of(scene.surface.kind).dimensions != 2 && is_plane_only(terms[i])) {
            throw SceneError(fmt::format(
                "relief.{}.type: only over a height field, allowed: surface.kind = \"terrain\"", terms[i].name));
        }
    }
}

void check_ground(const Scene& scene) {
    if (scene.ground.size() > kMostGroundLayers) {
        throw SceneError(fmt::format("ground: {} layers, allowed: {} at most", scene.ground.size(), kMostGroundLayers));
    }
    for (std::size_t i = 0; i < scene.ground.size(); ++i) {
        if (const std::string problem = ground_problem(scene.ground, i); !problem.empty()) throw SceneError(problem);
    }
    for (const GroundLayer& layer : scene.ground) {
        const double cells = finest_ground_cells(layer), farthest = noise_reach(scene);
        if (cells * farthest <= kMostCells) continue;
        throw SceneError(fmt::format(
            "ground.{}: its finest noise has {:.3g} cells a surface unit, and is seen up to {:.3g} surface units from "
            "surface.origin: more than 2^50 cells, too fine for double precision, allowed: fewer octaves, larger "
            "sizes, or a lower camera.far",
            layer.name, cells, farthest));
    }
}

// Seconds from time 0 at which the frame is, before or after.
double latest(const Scene& scene) {
    const TimeSpan open = open_shutter(scene);
    return std::max(std::abs(open.first), std::abs(open.last));
}

// Clouds are lit by daylight, which has its horizon level. A layer is a sphere about the Earth's middle, so that none
// of it is seen further aside from under the eye than its radius, 6.4e6 m.
void check_clouds(const Scene& scene) {
    if (scene.clouds.size() > kMostCloudLayers) {
        throw SceneError(fmt::format("clouds: {} layers, allowed: {} at most", scene.clouds.size(), kMostCloudLayers));
    }
    for (std::size_t i = 0; i < scene.clouds.size(); ++i) {
        const CloudLayer& layer = scene.clouds[i];
        if (const std::string problem = cloud_problem(scene.clouds, i); !problem.empty()) throw SceneError(problem);
        if (scene.sky.model != SkyModel::daylight) {
            throw SceneError(fmt::format(
                "clouds.{}: lit by daylight alone, allowed: sky.model = \"daylight\", or no clouds", layer.name));
        }
        const double cells = finest_cloud_cells(layer), farthest = reach(scene) * scene.scale.metres + 6.4e6 +
                                                                   layer.warp_m + layer.wind_m_s * latest(scene);
        if (cells * farthest <= kMostCells) continue;
        throw SceneError(fmt::format(
            "clouds.{}: its finest noise has {:.3g} cells a metre, and is seen up to {:.3g} m from surface.origin: "
            "more than 2^50 cells, too fine for double precision, allowed: fewer octaves, a larger size_m, {}or a lower "
            "camera.far",
            layer.name, cells, farthest, layer.wind_m_s > 0.0 ? "less wind, an earlier frame, " : ""));
    }
}

noise::Relief relief_of(const Surface& surface) {
    try {
        return {surface.relief, solid::row_of(surface.kind).dimensions};
    } catch (const std::invalid_argument& refused) {
        throw SceneError(refused.what());
    }
}

// The relief's octaves, wherever a warp reads them.
void check_relief_octaves(const Scene& scene) {
    const Surface& surface = scene.surface;
    const noise::Relief relief = relief_of(surface);
    double displaced = 0.0;
    for (const noise::ReliefPart& part : relief.parts()) {
        if (!part.inputs.empty() && !part.octaves.empty()) displaced += part.amplitude_from.front();
    }
    const double farthest = noise_reach(scene) + displaced;
    if (relief.finest_frequency() * farthest <= kMostCells) return;
    throw SceneError(fmt::format(
        "relief: its finest octave has {:.3g} lattice cells a surface unit, and is seen up to {:.3g} surface units "
        "from surface.origin: more than 2^50 cells, too fine for double precision, allowed: fewer octaves, lower "
        "frequencies, or a lower camera.far",
        relief.finest_frequency(), farthest));
}

std::string point_text(const glm::dvec3& p) {
    return fmt::format("[{}, {}, {}]", number_text(p.x), number_text(p.y), number_text(p.z));
}

void check_view(const Camera& camera) {
    const CameraPath path(camera);
    const auto time = path.meeting_time(kShortestDirection);
    if (!time) return;
    const std::string when = path.moves() ? fmt::format(" at {} s", number_text(*time)) : std::string();
    throw SceneError(
        fmt::format("camera.look_at: is the same point as camera.position{} ({}), allowed: any other point", when,
                    point_text(path.at(*time).look_at)));
}

void check_octaves(const Scene& scene) {
    const Surface& surface = scene.surface;
    const double farthest = noise_reach(scene);
    const std::string drifted = farthest > reach(scene) ? ", with surface.drift," : "";
    double amplitude = surface.amplitude;
    double frequency = surface.frequency;
    for (int k = 0; k < surface.octaves && amplitude != 0.0; ++k) {
        if (!(frequency * farthest <= kMostCells)) {
            const std::string octaves =
                k > 0 ? fmt::format("surface.octaves up to {}, or a lower surface.lacunarity, ", k)
                      : std::string("a lower ");
            const std::string_view reach_key = solid::row_of(surface.kind).reach_key;
            throw SceneError(
                fmt::format("surface.octaves: octave {} of {} is too fine for double precision ({:.3g} lattice cells a "
                            "surface unit, seen up to {:.3g} surface units from surface.origin{} exceed 2^50 cells), "
                            "allowed: {}surface.frequency or {}",
                            k + 1, surface.octaves, frequency, farthest, drifted.empty() ? "," : drifted, octaves,
                            !drifted.empty()    ? "surface.drift, or an earlier frame"
                            : reach_key.empty() ? "camera.far, or a camera nearer to surface.origin"
                                                : reach_key));
        }
        amplitude *= surface.gain;
        frequency *= surface.lacunarity;
    }
}

}  // namespace

double reach(const Scene& scene) {
    const Surface& surface = scene.surface;
    double eye = 0.0;
    for (const glm::dvec3& x : CameraPath(scene.camera).position_hull(open_shutter(scene))) {
        eye = std::max(eye, glm::distance(x, surface.origin));
    }
    // Sky rays go on from what was met, and others from water, each as far as the eye's. The last shadow ray has a
    // factor of 2 to go further.
    const double stretches = (needs_sky_rays(scene) ? 1.0 + scene.sky.bounces : 1.0) + (needs_water(scene) ? 1.0 : 0.0);
    const double along_rays = (eye + stretches * scene.camera.far) / surface.scale;
    return solid::visit([&](const auto& shape) { return shape.reach(along_rays); }, surface.solid());
}

double noise_reach(const Scene& scene) { return reach(scene) + glm::length(scene.surface.drift) * latest(scene); }

void validate(const Scene& scene, std::string_view source_name) {
    try {
        check_fields(scene);
        if (scene.image == ImageKind::surface) {
            check_view(scene.camera);
            check_daylight(scene);
            check_fog(scene);
            check_water(scene);
            check_relief(scene);
            check_ground(scene);
            check_clouds(scene);
            if (scene.surface.relief.empty()) {
                check_octaves(scene);
            } else {
                check_relief_octaves(scene);
            }
        }
    } catch (const SceneError& error) {
        if (source_name.empty()) throw;
        throw SceneError(fmt::format("{}: {}", source_name, error.what()));
    }
}

}  // namespace strata::scene
