// A scene's surface, at a time in seconds, as the field's oracle takes it.
#pragma once

#include "src/scene/scene.h"
#include "tools/stability/oracles/field_oracle.h"

namespace strata::oracle {

inline Vec as_vec(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// What the oracle calls each kind of solid. A kind without a line here does not compile.
inline void describe(const solid::HeightField& /*s*/, Shape& shape) { shape.kind = Kind::terrain; }
inline void describe(const solid::DisplacedPlane& /*s*/, Shape& shape) { shape.kind = Kind::hyperterrain; }
inline void describe(const solid::Sphere& s, Shape& shape) {
    shape.kind = Kind::planet;
    shape.radius = s.radius;
}
inline void describe(const solid::LevelSet& s, Shape& shape) {
    shape.kind = Kind::isosurface;
    shape.threshold = s.threshold;
    shape.container = s.bound == solid::LevelSet::Bound::ball ? Container::ball : Container::box;
    shape.container_size = {s.bound_size.x, s.bound_size.y, s.bound_size.z};
}

static_assert(solid::kKinds == kShapeKinds, "each kind of solid has a shape of the oracle's own, and the other way");

inline Shape shape_of(const scene::Surface& s, double time = 0.0) {
    Shape shape;
    solid::visit([&](const auto& solid) { describe(solid, shape); }, s.solid());
    shape.octaves = s.octaves;
    shape.lacunarity = s.lacunarity;
    shape.gain = s.gain;
    shape.amplitude = s.amplitude;
    shape.frequency = s.frequency;
    shape.seed = s.seed;
    shape.drift = {s.drift.x, s.drift.y, s.drift.z};
    shape.time = time;
    return shape;
}

}  // namespace strata::oracle
