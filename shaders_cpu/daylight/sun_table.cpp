#include "shaders_cpu/daylight/sun_table.h"

#include <cmath>
#include <numbers>

namespace strata::shaders {
namespace {

constexpr int kSunTableHeights = 80;  // as the fourth power of their number: 1 km up they lie 160 m apart
// As the fourth power too, from where the disc is just below the horizon, where they lie 1/60 degree apart: seen from
// 15 km up, light that passes the Earth in haze changes tenfold in 1/20 degree.
constexpr int kSunTableSuns = 320;
constexpr double kBelowHorizon = 0.005;

double sun_table_height(int i) {
    const double x = static_cast<double>(i) / (kSunTableHeights - 1);
    return kAirTop * x * x * x * x;
}

// Share of a unit disc above a horizon that lies `a` below its middle.
double visible_share(double a) {
    if (a >= 1.0) return 1.0;
    if (a <= -1.0) return 0.0;
    return 0.5 + (std::asin(a) + a * std::sqrt(1.0 - a * a)) / std::numbers::pi;
}

Sunlight through_air(const AirModel& medium, double height, double up) {
    const Densities columns = columns_to_top(medium, height, up);
    return {glm::exp(-medium.full().depth(columns)), glm::exp(-medium.diffuse().depth(columns))};
}

}  // namespace

Sunlight sunlight(const AirModel& medium, double height, double sun_up) {
    constexpr double kSteepAir = 6.0;  // radii above the horizon below which air dims a disc unevenly
    constexpr int kStrips = 4;
    const double zenith_angle = std::acos(std::clamp(sun_up, -1.0, 1.0));
    const double horizon = horizon_up(height);
    const double above = (std::acos(horizon) - zenith_angle) / kSunRadius;
    const double share = visible_share(above);
    if (share <= 0.0) return {Bands(0.0), Bands(0.0)};
    if (above > kSteepAir) return through_air(medium, height, sun_up);
    // Strips of what shows of the disc, each as bright as its chord is long.
    const double lowest = std::max(-1.0, -above);
    Sunlight sum{Bands(0.0), Bands(0.0)};
    double chords = 0.0;
    for (int k = 0; k < kStrips; ++k) {
        const double y = lowest + (1.0 - lowest) * (k + 0.5) / kStrips;
        const double chord = std::sqrt(1.0 - y * y);
        const Sunlight strip = through_air(medium, height, std::max(horizon, std::cos(zenith_angle - y * kSunRadius)));
        sum.full += chord * strip.full;
        sum.diffuse += chord * strip.diffuse;
        chords += chord;
    }
    return {share / chords * sum.full, share / chords * sum.diffuse};
}

SunTable::SunTable(const AirModel& medium) : nodes_(kSunTableHeights * kSunTableSuns) {
    for (int i = 0; i < kSunTableHeights; ++i) {
        const double height = sun_table_height(i);
        const double floor = horizon_up(height) - kBelowHorizon;
        for (int k = 0; k < kSunTableSuns; ++k) {
            const double x = static_cast<double>(k) / (kSunTableSuns - 1);
            const Sunlight light = sunlight(medium, height, floor + (1.0 - floor) * x * x * x * x);
            for (int b = 0; b < 4; ++b) {
                nodes_[i * kSunTableSuns + k].light[b] = static_cast<float>(light.full[b]);
                nodes_[i * kSunTableSuns + k].light[b + 4] = static_cast<float>(light.diffuse[b]);
            }
        }
    }
}

Cell SunTable::height_cell(double height) {
    return cell_of(fourth_root(std::max(height, 0.0) / kAirTop), kSunTableHeights);
}

Sunlight SunTable::at(const Cell& height, double horizon, double sun_up) const {
    const double floor = horizon - kBelowHorizon;
    if (sun_up <= floor) return {Bands(0.0), Bands(0.0)};
    const Cell sun = cell_of(fourth_root((sun_up - floor) / (1.0 - floor)), kSunTableSuns);
    const Node* low = &nodes_[height.index * kSunTableSuns + sun.index];
    const Node* high = low + kSunTableSuns;
    float light[8];
    for (int b = 0; b < 8; ++b)
        light[b] = blend(blend(low[0].light[b], low[1].light[b], sun.fraction),
                         blend(high[0].light[b], high[1].light[b], sun.fraction), height.fraction);
    return {Bands(light[0], light[1], light[2], light[3]), Bands(light[4], light[5], light[6], light[7])};
}

}  // namespace strata::shaders
