#include "src/trace/field.h"

#include <algorithm>
#include <cmath>

#include "noise/bounds.h"
#include "noise/reference.h"
#include "src/scene/needs.h"

namespace strata::trace {

namespace {

using scene::SurfaceKind;

std::vector<noise::Octave> live_octaves(const scene::Surface& surface) {
    if (!surface.relief.empty()) return {};
    std::vector<noise::Octave> octaves = noise::make_octaves({.octaves = surface.octaves,
                                                              .lacunarity = surface.lacunarity,
                                                              .gain = surface.gain,
                                                              .amplitude = surface.amplitude,
                                                              .frequency = surface.frequency,
                                                              .seed = surface.seed});
    // What is below the last bit of a double beside the first octave, in value and in slope, changes nothing.
    const double least = octaves.front().amplitude * 0x1p-70;
    const double least_slope = least * octaves.front().frequency;
    std::erase_if(octaves, [&](const noise::Octave& octave) {
        return octave.amplitude <= least && octave.amplitude * octave.frequency <= least_slope;
    });
    return octaves;
}

Interval clip_ball(const glm::dvec3& origin, const glm::dvec3& direction, double radius, double limit) {
    const double middle = -glm::dot(origin, direction);
    const glm::dvec3 nearest = origin + middle * direction;
    const double half_squared = radius * radius - glm::dot(nearest, nearest);
    if (half_squared <= 0.0) return {};
    const double half = std::sqrt(half_squared);
    return {std::max(0.0, middle - half), std::min(limit, middle + half), middle - half > 0.0};
}

Interval clip_box(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& half, double limit) {
    Interval inside{0.0, limit};
    for (int a = 0; a < 3; ++a) {
        if (direction[a] == 0.0) {
            if (std::abs(origin[a]) > half[a]) return {};
            continue;
        }
        const double sign = std::copysign(1.0, direction[a]);
        const double enter = (-sign * half[a] - origin[a]) / direction[a];
        if (enter > inside.begin) {
            inside.begin = enter;
            inside.enters_bound = true;
        }
        inside.end = std::min(inside.end, (sign * half[a] - origin[a]) / direction[a]);
    }
    return inside;
}

}  // namespace

Field::Field(const scene::Surface& surface)
    : surface_(surface), octaves_(live_octaves(surface)), drifts_(scene::noise_drifts(surface)) {
    const noise::NoiseBounds& bounds = is_planar_noise() ? noise::kBounds2 : noise::kBounds3;
    const double base_slope = surface_.kind == SurfaceKind::isosurface ? 0.0 : 1.0;
    lipschitz_ = base_slope;
    if (!surface.relief.empty()) {
        relief_ = std::make_shared<noise::Relief>(surface.relief, is_planar_noise() ? 2 : 3);
        amplitude_ = relief_->certificate().size();
        lipschitz_ += relief_->certificate().slope;
    }
    for (const noise::Octave& octave : octaves_) {
        amplitude_ += octave.amplitude * bounds.value;
        lipschitz_ += octave.amplitude * octave.frequency * bounds.gradient;
    }
}

double Field::base(const glm::dvec3& x) const {
    switch (surface_.kind) {
        case SurfaceKind::terrain:
        case SurfaceKind::hyperterrain:
            return x.y;
        case SurfaceKind::planet:
            return glm::length(x) - surface_.radius;
        case SurfaceKind::isosurface:
            return surface_.threshold;
    }
    return 0.0;
}

double Field::octave(std::size_t k, const glm::dvec3& x, const glm::dvec3& shift) const {
    const noise::Octave& octave = octaves_[k];
    const glm::dvec3 at = x + shift;
    if (is_planar_noise()) {
        const auto p = noise::octave_position<2>(octave, {at.x, at.z});
        return octave.amplitude * noise::reference_value<2>(octave.key, noise::split_position<2>(p));
    }
    const auto p = noise::octave_position<3>(octave, {at.x, at.y, at.z});
    return octave.amplitude * noise::reference_value<3>(octave.key, noise::split_position<3>(p));
}

double Field::value(const glm::dvec3& x, const glm::dvec3& shift) const {
    double f = base(x);
    if (relief_) return f - relief_->jet(x + shift).value;
    for (std::size_t k = 0; k < octaves_.size(); ++k) f -= octave(k, x, shift);
    return f;
}

glm::dvec3 Field::base_gradient(const glm::dvec3& x) const {
    constexpr glm::dvec3 kUp{0.0, 1.0, 0.0};
    if (surface_.kind == SurfaceKind::isosurface) return glm::dvec3(0.0);
    if (surface_.kind != SurfaceKind::planet) return kUp;
    const double radius = glm::length(x);
    return radius > 0.0 ? x / radius : kUp;
}

glm::dvec3 Field::gradient(const glm::dvec3& x, const glm::dvec3& shift) const {
    glm::dvec3 gradient = base_gradient(x);
    const glm::dvec3 at = x + shift;
    if (relief_) return gradient - relief_->jet(at).gradient;
    for (const noise::Octave& octave : octaves_) {
        const double slope = octave.amplitude * octave.frequency;
        if (is_planar_noise()) {
            const auto p = noise::octave_position<2>(octave, {at.x, at.z});
            const auto jet = noise::reference_jet<2>(octave.key, noise::split_position<2>(p));
            gradient -= slope * glm::dvec3(jet.gradient[0], 0.0, jet.gradient[1]);
        } else {
            const auto p = noise::octave_position<3>(octave, {at.x, at.y, at.z});
            const auto jet = noise::reference_jet<3>(octave.key, noise::split_position<3>(p));
            gradient -= slope * glm::dvec3(jet.gradient[0], jet.gradient[1], jet.gradient[2]);
        }
    }
    return gradient;
}

Interval Field::clip_bounded(const glm::dvec3& origin, const glm::dvec3& direction, double limit) const {
    if (surface_.kind == SurfaceKind::planet) {
        const double reach = surface_.radius + amplitude_;
        Interval shell = clip_ball(origin, direction, reach + kClipSlack * (reach + glm::length(origin)), limit);
        shell.enters_bound = false;
        return shell;
    }
    if (surface_.bound == scene::BoundKind::box) return clip_box(origin, direction, surface_.bound_size, limit);
    return clip_ball(origin, direction, surface_.bound_size.x, limit);
}

glm::dvec3 Field::bound_normal(const glm::dvec3& x) const {
    if (surface_.bound == scene::BoundKind::ball) return glm::normalize(x);
    const glm::dvec3 scaled = glm::abs(x) / surface_.bound_size;
    glm::dvec3 normal{0.0};
    const int axis = scaled.x >= scaled.y && scaled.x >= scaled.z ? 0 : scaled.y >= scaled.z ? 1 : 2;
    normal[axis] = std::copysign(1.0, x[axis]);
    return normal;
}

}  // namespace strata::trace
