#include "shaders_cpu/materials/terrain.h"

#include <algorithm>
#include <cmath>

#include "shaders_cpu/arc_cosine.h"

namespace strata::shaders {
namespace {

// 0 to 1 over [centre - width/2, centre + width/2], width > 0.
float blend(double x, double centre, double width) {
    const double s = std::clamp((x - centre) / width + 0.5, 0.0, 1.0);
    return static_cast<float>(s * s * (3.0 - 2.0 * s));
}

}  // namespace

TerrainMaterial::TerrainMaterial(const scene::Material& material)
    : material_(material), low_(material.low), rise_(material.high - material.low), steep_(material.steep) {}

float TerrainMaterial::high(double height) const { return blend(height, material_.band_height, material_.band_width); }

float TerrainMaterial::steepness(double slope_cosine) const {
    const double slope_deg = arc_cosine_deg(std::clamp(slope_cosine, -1.0, 1.0));
    return blend(slope_deg, material_.steep_deg, material_.steep_width_deg);
}

double TerrainMaterial::height_mask(const ShadingPoint& point) const { return static_cast<double>(high(point.height)); }

double TerrainMaterial::slope_mask(const ShadingPoint& point) const {
    return static_cast<double>(steepness(point.up_dot_normal));
}

glm::vec3 TerrainMaterial::albedo(double height, double slope_cosine) const {
    const glm::vec3 gentle = low_ + rise_ * high(height);
    const float steep = steepness(slope_cosine);
    return gentle * (1.0f - steep) + steep_ * steep;
}

}  // namespace strata::shaders
