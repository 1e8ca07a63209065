#include "shaders_cpu/daylight/sky_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strata::shaders {
namespace {

constexpr int kUpsAbove = 144;
constexpr int kUpsBelow = 64;
constexpr int kSkyAzimuths = 33;

void put_sky(const glm::dvec3& rgb, float (&to)[4]) {
    for (int c = 0; c < 3; ++c) to[c] = static_cast<float>(rgb[c]);
    to[3] = 0.0f;
}

}  // namespace

SkyTable::SkyTable(const AirLight& light, const SkyFrame& frame) : horizon_(horizon_up(frame.height)) {
    nodes_.reserve((kUpsAbove + kUpsBelow) * kSkyAzimuths);
    const auto add_rows = [&](int rows, double reach, bool ground) {
        for (int k = 0; k < rows; ++k) {
            const double x = static_cast<double>(k) / (rows - 1);
            const double up = std::clamp(horizon_ + reach * x * x, -1.0, 1.0);
            const double end = !ground ? std::numeric_limits<double>::infinity()
                               : k > 0 ? distance_to_ground(frame.height, up)
                                       : -(kEarthRadius + frame.height) * horizon_;
            const AirPath path(light.medium(), frame.height, up, end, AirLight::kPathSteps);
            for (int a = 0; a < kSkyAzimuths; ++a) {
                const double cosine = frame.cosine_of(up, -1.0 + 2.0 * a / (kSkyAzimuths - 1));
                AirRadiance seen = light.of_path(path, frame.sun.y, cosine);
                if (ground) seen.even += light.of_ground(path, frame.sun.y, cosine);
                Node node;
                put_sky(to_rgb(seen.even), node.even);
                put_sky(to_rgb(seen.lobe), node.lobe);
                nodes_.push_back(node);
            }
        }
    };
    add_rows(kUpsAbove, 1.0 - horizon_, false);
    add_rows(kUpsBelow, -1.0 - horizon_, true);
}

glm::dvec3 SkyTable::radiance(const AirModel& medium, const SkyDirection& direction) const {
    const bool above = direction.up >= horizon_;
    const double reach = above ? 1.0 - horizon_ : -1.0 - horizon_;
    const Cell up = cell_of(std::sqrt((direction.up - horizon_) / reach), above ? kUpsAbove : kUpsBelow);
    const Cell azimuth = cell_of(0.5 * (1.0 + direction.azimuth), kSkyAzimuths);
    const Node* low = &nodes_[((above ? 0 : kUpsAbove) + up.index) * kSkyAzimuths + azimuth.index];
    const Node* high = low + kSkyAzimuths;
    const auto lobe = static_cast<float>(medium.haze_lobe(direction.cosine));
    float rgb[4];
    for (int c = 0; c < 4; ++c) {
        const auto mix = [&](const Node& node) { return node.even[c] + lobe * node.lobe[c]; };
        rgb[c] = blend(blend(mix(low[0]), mix(low[1]), azimuth.fraction),
                       blend(mix(high[0]), mix(high[1]), azimuth.fraction), up.fraction);
    }
    return {std::max(rgb[0], 0.0f), std::max(rgb[1], 0.0f), std::max(rgb[2], 0.0f)};
}

}  // namespace strata::shaders
