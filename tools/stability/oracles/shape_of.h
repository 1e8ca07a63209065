// A scene's surface, at a time in seconds, as the field's oracle takes it.
#pragma once

#include "src/scene/scene.h"
#include "tools/stability/oracles/field_oracle.h"

namespace strata::oracle {

inline Vec as_vec(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

inline Shape shape_of(const scene::Surface& s, double time = 0.0) {
    Shape shape;
    shape.kind = static_cast<Kind>(s.kind);
    shape.octaves = s.octaves;
    shape.lacunarity = s.lacunarity;
    shape.gain = s.gain;
    shape.amplitude = s.amplitude;
    shape.frequency = s.frequency;
    shape.seed = s.seed;
    shape.radius = s.radius;
    shape.threshold = s.threshold;
    shape.drift = {s.drift.x, s.drift.y, s.drift.z};
    shape.time = time;
    if (s.kind == scene::SurfaceKind::isosurface) {
        shape.container = s.bound == scene::BoundKind::ball ? Container::ball : Container::box;
        shape.container_size = {s.bound_size.x, s.bound_size.y, s.bound_size.z};
    }
    return shape;
}

}  // namespace strata::oracle
