#include "shaders_cpu/daylight/aerial_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strata::shaders {
namespace {

constexpr int kUps = 65;  // odd: one lies at the horizon
constexpr int kAzimuths = 13;
constexpr int kDistances = 65;      // as the fourth power: 1 km away they lie 0.4 km apart, at 100 km 12
constexpr int kStepsADistance = 2;  // of the integral
constexpr double kFarthest = 1200e3;

double distance_of(double k) {
    const double x = k / (kDistances - 1);
    return kFarthest * x * x * x * x;
}

void put(const glm::dvec3& rgb, float (&to)[4]) {
    for (int c = 0; c < 3; ++c) to[c] = static_cast<float>(rgb[c]);
    to[3] = 0.0f;
}

glm::dvec3 at_least_zero(const glm::dvec3& rgb) { return glm::max(rgb, glm::dvec3(0.0)); }

// Roots away from the horizon, both up and down.
double up_of(int k, double horizon) {
    const double x = 2.0 * k / (kUps - 1) - 1.0;
    return std::clamp(horizon + (x < 0.0 ? -1.0 - horizon : 1.0 - horizon) * x * x, -1.0, 1.0);
}

Cell up_cell(double up, double horizon) {
    const double x =
        up < horizon ? -std::sqrt((up - horizon) / (-1.0 - horizon)) : std::sqrt((up - horizon) / (1.0 - horizon));
    return cell_of(0.5 * (1.0 + x), kUps);
}

// Linear in the distance between nodes, so that a short way is in proportion.
Cell distance_cell(double distance) {
    Cell cell = cell_of(fourth_root(std::max(distance, 0.0) / kFarthest), kDistances);
    const double from = distance_of(cell.index);
    const double to = distance_of(cell.index + 1);
    cell.fraction = static_cast<float>(std::clamp((distance - from) / (to - from), 0.0, 1.0));
    return cell;
}

std::array<double, (kDistances - 1) * kStepsADistance + 1> step_distances() {
    std::array<double, (kDistances - 1) * kStepsADistance + 1> edges;
    for (std::size_t k = 0; k < edges.size(); ++k) edges[k] = distance_of(static_cast<double>(k) / kStepsADistance);
    return edges;
}

}  // namespace

AerialPerspective integrate_aerial(const AirLight& light, double height, double sun_up, const SkyDirection& direction,
                                   double distance) {
    const AirPath path(light.medium(), height, direction.up, distance, AirLight::kPathSteps);
    const AirRadiance inscatter = light.of_path(path, sun_up, direction.cosine);
    return {glm::exp(-light.medium().channels().depth(path.columns())),
            at_least_zero(to_rgb(light.total(inscatter, direction.cosine)))};
}

AerialTable::AerialTable(const AirLight& light, const SkyFrame& frame) : horizon_(horizon_up(frame.height)) {
    nodes_.reserve(kUps * kAzimuths * kDistances);
    const auto edges = step_distances();
    for (int k = 0; k < kUps; ++k) {
        const double up = up_of(k, horizon_);
        const AirPath path(light.medium(), frame.height, up, edges);
        for (int a = 0; a < kAzimuths; ++a)
            add_line(light, frame, path, frame.cosine_of(up, -1.0 + 2.0 * a / (kAzimuths - 1)));
    }
}

void AerialTable::add_line(const AirLight& light, const SkyFrame& frame, const AirPath& path, double cosine) {
    AirRadiance sum;
    nodes_.push_back({{1.0f, 1.0f, 1.0f, 1.0f}, {}, {}});
    for (std::size_t s = 0; s < path.steps().size(); ++s) {
        const AirStep& step = path.steps()[s];
        sum += light.of_step(path, step, frame.sun.y, cosine);
        if (s % kStepsADistance != kStepsADistance - 1) continue;
        Node node;
        put(glm::exp(-light.medium().channels().depth(step.columns)), node.transmittance);
        put(to_rgb(sum.even), node.even);
        put(to_rgb(sum.lobe), node.lobe);
        nodes_.push_back(node);
    }
}

AerialPerspective AerialTable::at(const AirModel& medium, const SkyDirection& direction, double distance) const {
    const Cell up = up_cell(direction.up, horizon_);
    const Cell azimuth = cell_of(0.5 * (1.0 + direction.azimuth), kAzimuths);
    const Cell far = distance_cell(distance);
    const auto lobe = static_cast<float>(medium.haze_lobe(direction.cosine));
    const Node* low = &nodes_[(up.index * kAzimuths + azimuth.index) * kDistances + far.index];
    const Node* high = low + kAzimuths * kDistances;
    float transmittance[4], inscatter[4];
    for (int c = 0; c < 4; ++c) {
        const auto along = [&](const auto& value) {
            const auto line = [&](const Node* node) { return blend(value(node[0]), value(node[1]), far.fraction); };
            return blend(blend(line(low), line(low + kDistances), azimuth.fraction),
                         blend(line(high), line(high + kDistances), azimuth.fraction), up.fraction);
        };
        transmittance[c] = along([&](const Node& node) { return node.transmittance[c]; });
        inscatter[c] = along([&](const Node& node) { return node.even[c] + lobe * node.lobe[c]; });
    }
    return {glm::dvec3(transmittance[0], transmittance[1], transmittance[2]),
            at_least_zero(glm::dvec3(inscatter[0], inscatter[1], inscatter[2]))};
}

}  // namespace strata::shaders
