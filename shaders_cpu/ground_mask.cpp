#include "shaders_cpu/ground_mask.h"

#include <algorithm>

namespace strata::shaders {

namespace {

// Beds rise and sink by a few octaves: more would tear them.
constexpr int kWarpOctaves = 3;
constexpr double kWarpGain = 0.4;

// Of a quantity that rises by at most 1 along a stretch of length 1.
double variance_along(double stretch) { return stretch * stretch / 12.0; }

double squared(double x) { return x * x; }

}  // namespace

GroundTexture::GroundTexture(const scene::GroundNoise& noise)
    : cells_(1.0 / noise.size, 1.0 / (noise.size * noise.stretch), 1.0 / noise.size),
      finest_(std::max(cells_.x, cells_.y)),
      noise_({.octaves = noise.octaves, .gain = noise.gain, .seed = noise.seed}) {}

GroundBeds::GroundBeds(const scene::GroundStrata& strata)
    : strata_(strata),
      finest_(std::max(1.0 / strata.thickness, 1.0 / strata.length)),
      beds_({.octaves = strata.octaves, .gain = strata.gain, .seed = strata.seed}),
      warp_({.octaves = kWarpOctaves, .gain = kWarpGain, .seed = strata.seed + 1}) {}

FilteredValue GroundBeds::at(const GroundPoint& point) const {
    double height = point.height;
    if (strata_.warp > 0.0) {
        const double footprint = point.footprint / strata_.warp_size;
        height += strata_.warp * warp_(point.x / strata_.warp_size, footprint).value;
    }
    const glm::dvec3 across = point.x / strata_.length;
    return beds_({across.x, across.y + height / strata_.thickness, across.z}, point.footprint * finest_);
}

GroundMask::GroundMask(const scene::GroundLayer& layer)
    : cover_(layer.cover),
      height_(layer.height, -scene::kEndOfHeights, scene::kEndOfHeights),
      slope_(layer.slope_deg, 0.0, 180.0),
      facing_(layer.facing, -1.0, 1.0),
      patches_(layer.patches, -scene::kEndOfNoise, scene::kEndOfNoise),
      beds_range_(layer.beds, -scene::kEndOfNoise, scene::kEndOfNoise),
      height_noise_(height_.is_everything() ? 0.0 : layer.height_noise),
      slope_noise_(slope_.is_everything() ? 0.0 : layer.slope_noise_deg),
      aspect_(glm::normalize(layer.aspect)) {
    if (height_noise_ > 0.0 || slope_noise_ > 0.0 || !patches_.is_everything()) noise_.emplace(layer.noise);
    if (!beds_range_.is_everything()) beds_.emplace(layer.strata);
}

// The part of the normal along aspect, of which what is along up is left out: a continuous quantity also where ground
// is level, which an angle between directions of slopes is not.
double GroundMask::facing_share(const GroundPoint& point) const {
    if (facing_.is_everything()) return 1.0;
    const glm::dvec3 level = aspect_ - point.up * glm::dot(point.up, aspect_);
    return facing_(glm::dot(point.normal, level), 0.0);
}

double GroundMask::noisy_share(const GroundPoint& point) const {
    const double along_height = variance_along(point.footprint);
    if (!noise_) return height_(point.height, along_height) * slope_(point.slope_deg, 0.0);
    // Most points are far from the edges, and know it without a look at the noise.
    const double most = noise_->most();
    if (height_.is_nothing_near(point.height, height_noise_ * most, along_height + squared(height_noise_)) ||
        slope_.is_nothing_near(point.slope_deg, slope_noise_ * most, squared(slope_noise_))) {
        return 0.0;
    }
    const FilteredValue noise = noise_->at(point);
    return height_(point.height + height_noise_ * noise.value, along_height + squared(height_noise_) * noise.variance) *
           slope_(point.slope_deg + slope_noise_ * noise.value, squared(slope_noise_) * noise.variance) *
           patches_(noise.value, noise.variance);
}

double GroundMask::operator()(const GroundPoint& point) const {
    double share = cover_ * facing_share(point);
    if (share > 0.0) share *= noisy_share(point);
    if (share > 0.0 && beds_) {
        const FilteredValue beds = beds_->at(point);
        share *= beds_range_(beds.value, beds.variance);
    }
    return share;
}

}  // namespace strata::shaders
