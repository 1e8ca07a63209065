#include "src/trace/field.h"

#include "noise/bounds.h"
#include "noise/reference.h"
#include "src/scene/needs.h"
#include "src/trace/relief_plan.h"
#include "src/trace/trace_plan.h"

namespace strata::trace {

namespace {

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

}  // namespace

Field::Field(const scene::Surface& surface)
    : surface_(surface),
      solid_(surface.solid()),
      is_planar_noise_(solid::row_of(surface.kind).dimensions == 2),
      octaves_(live_octaves(surface)),
      drifts_(scene::noise_drifts(surface)) {
    const noise::NoiseBounds& bounds = is_planar_noise() ? noise::kBounds2 : noise::kBounds3;
    lipschitz_ = solid::visit([](const auto& s) { return s.kSteepest; }, solid_);
    if (!surface.relief.empty()) {
        relief_ = std::make_shared<noise::Relief>(surface.relief, is_planar_noise() ? 2 : 3);
        amplitude_ = relief_->certificate().size();
        lipschitz_ += relief_->certificate().slope;
    }
    for (const noise::Octave& octave : octaves_) {
        amplitude_ += octave.amplitude * bounds.value;
        lipschitz_ += octave.amplitude * octave.frequency * bounds.gradient;
    }
    if (relief_) relief_plan_ = std::make_shared<ReliefPlan>(*relief_);
    plan_ = std::make_shared<TracePlan>(*this);
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

glm::dvec3 Field::bound_normal(const glm::dvec3& x) const {
    return solid::visit(
        [&]<class S>(const S& s) {
            if constexpr (solid::kHasBound<S>) return s.bound_normal(x);
            return s.up(x);
        },
        solid_);
}

}  // namespace strata::trace
