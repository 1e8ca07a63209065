#include "src/scene/cloud_keys.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "src/scene/key_makers.h"
#include "src/scene/named_list.h"

namespace strata::scene {

namespace {

std::vector<Key> cloud_shape_keys(CloudLayer& layer) {
    using namespace key_makers;
    return {
        number("coverage", layer.coverage, kFraction, "", "share of the sky where there is cloud, thin edges included"),
        number("edge", layer.edge, {1e-3, 100.0}, "root mean squares of the noise",
               "how far from a cloud's rim, by the noise, it is `depth` deep: small is crisp"),
        number("size_m", layer.size_m, {1.0, 1e6}, "m", "cells of the noise's coarsest octave"),
        number("stretch", layer.stretch, {0.01, 100.0}, "", "how much longer cells are along stretch_deg: streaks"),
        number("stretch_deg", layer.stretch_deg, kAngle, "degrees", "that direction in the plan, from x to z"),
        number("warp_m", layer.warp_m, {0.0, 1e6}, "m", "how far another noise bends the plan, about"),
        number("wind_m_s", layer.wind_m_s, {0.0, 1000.0}, "m/s", "at which the layer drifts as a whole"),
        number("wind_deg", layer.wind_deg, kAngle, "degrees", "where to, in the plan, from x to z"),
        count("octaves", layer.octaves, {1, 16}, "", "terms of the noise's sum, each twice as fine"),
        number("gain", layer.gain, kFraction, "", "amplitude ratio of neighbouring octaves"),
        plain("seed", layer.seed, "chooses the noise; equal ones are equal noises"),
    };
}

}  // namespace

Section describe_cloud_layer(CloudLayer& layer) {
    using namespace key_makers;
    std::vector<Key> keys{
        plain("name", layer.name, "what messages and --set call it"),
        number("altitude_m", layer.altitude_m, {1.0, 20'000.0}, "m", "its height over the surface's y = 0"),
        number("thickness_m", layer.thickness_m, {1.0, 5000.0}, "m",
               "over which sunlight goes sideways in it: shades what is turned from the sun"),
        number("depth", layer.depth, {0.0, 1000.0}, "",
               "optical depth `edge` within a cloud, up to twice that further in; 0: no clouds"),
        number("shadow", layer.shadow, kFraction, "",
               "share of its shadow that falls on the ground and into fog: 1 all, 0 none"),
    };
    for (Key& key : cloud_shape_keys(layer)) keys.push_back(std::move(key));
    Section made = section("clouds." + layer.name, "a layer of clouds", true, std::move(keys));
    made.is_term = true;
    return made;
}

double finest_cloud_cells(const CloudLayer& layer) {
    return std::ldexp(1.0 / (layer.size_m * std::min(layer.stretch, 1.0)), layer.octaves - 1);
}

std::string cloud_problem(std::span<const CloudLayer> layers, std::size_t i) {
    return name_problem("clouds", layers, i);
}

}  // namespace strata::scene
