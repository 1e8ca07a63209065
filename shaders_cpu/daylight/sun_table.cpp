#include "shaders_cpu/daylight/sun_table.h"

#include <cmath>
#include <numbers>

namespace strata::shaders {
namespace {

constexpr int kHeights = 80;  // as the fourth power of their number: 1 km up they lie 160 m apart
constexpr int kSuns = 192;    // as the square, from where the disc is just below the horizon: there 1/20 degree apart
constexpr double kBelowHorizon = 0.006;

double height_of(int i) {
    const double x = static_cast<double>(i) / (kHeights - 1);
    return kAirTop * x * x * x * x;
}

// What shows of a unit disc whose middle is `a` above the horizon: its share, and its centroid's height above the
// middle.
struct Visible {
    double share, centroid;
};

Visible visible_disc(double a) {
    if (a >= 1.0) return {1.0, 0.0};
    if (a <= -1.0) return {0.0, 0.0};
    const double chord = std::sqrt(1.0 - a * a);
    const double area = std::numbers::pi / 2 + std::asin(a) + a * chord;
    return {area / std::numbers::pi, area > 0.0 ? 2.0 / 3.0 * chord * chord * chord / area : 1.0};
}

}  // namespace

Sunlight sunlight(const Medium& medium, double height, double sun_up) {
    const double zenith_angle = std::acos(std::clamp(sun_up, -1.0, 1.0));
    const double horizon = horizon_up(height);
    const Visible disc = visible_disc((std::acos(horizon) - zenith_angle) / kSunRadius);
    if (disc.share <= 0.0) return {Bands(0.0), Bands(0.0)};
    const double up = std::max(horizon, std::cos(zenith_angle - disc.centroid * kSunRadius));
    const Densities columns = columns_to_top(medium, height, up);
    return {disc.share * glm::exp(-medium.full().depth(columns)),
            disc.share * glm::exp(-medium.diffuse().depth(columns))};
}

SunTable::SunTable(const Medium& medium) : nodes_(kHeights * kSuns) {
    for (int i = 0; i < kHeights; ++i) {
        const double height = height_of(i);
        const double floor = horizon_up(height) - kBelowHorizon;
        for (int k = 0; k < kSuns; ++k) {
            const double x = static_cast<double>(k) / (kSuns - 1);
            const Sunlight light = sunlight(medium, height, floor + (1.0 - floor) * x * x);
            for (int b = 0; b < 4; ++b) {
                nodes_[i * kSuns + k].light[b] = static_cast<float>(light.full[b]);
                nodes_[i * kSuns + k].light[b + 4] = static_cast<float>(light.diffuse[b]);
            }
        }
    }
}

Cell SunTable::height_cell(double height) { return cell_of(fourth_root(std::max(height, 0.0) / kAirTop), kHeights); }

Sunlight SunTable::at(const Cell& height, double horizon, double sun_up) const {
    const double floor = horizon - kBelowHorizon;
    if (sun_up <= floor) return {Bands(0.0), Bands(0.0)};
    const Cell sun = cell_of(std::sqrt((sun_up - floor) / (1.0 - floor)), kSuns);
    const Node* low = &nodes_[height.index * kSuns + sun.index];
    const Node* high = low + kSuns;
    float light[8];
    for (int b = 0; b < 8; ++b)
        light[b] = blend(blend(low[0].light[b], low[1].light[b], sun.fraction),
                         blend(high[0].light[b], high[1].light[b], sun.fraction), height.fraction);
    return {Bands(light[0], light[1], light[2], light[3]), Bands(light[4], light[5], light[6], light[7])};
}

}  // namespace strata::shaders
