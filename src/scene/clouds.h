// Layers of clouds, [[clouds]] in a scene file: plain values. cloud_keys.cpp documents every one.
#pragma once

#include <cstdint>
#include <string>

namespace strata::scene {

struct CloudLayer {
    std::string name;

    double altitude_m = 2500.0;  // over the surface's y = 0
    double thickness_m = 300.0;  // how far light goes sideways in it
    double coverage = 0.4;       // share of the plan over which there is cloud
    double depth = 12.0;         // optical, `edge` within a cloud
    double edge = 1.0;           // root mean squares of the noise
    double size_m = 5000.0;      // of the noise's coarsest cells
    double stretch = 1.0;        // how much longer these are along stretch_deg
    double stretch_deg = 0.0;    // in the plan, from x to z
    double warp_m = 0.0;         // how far another noise bends the plan
    double wind_m_s = 0.0;       // at which the layer drifts as a whole
    double wind_deg = 0.0;       // where to, in the plan, from x to z
    double shadow = 1.0;         // share of its own that falls on the ground and into fog
    int octaves = 8;
    double gain = 0.55;
    std::uint64_t seed = 1;

    bool is_there() const { return coverage > 0.0 && depth > 0.0; }
    bool drifts() const { return is_there() && wind_m_s > 0.0; }
};

}  // namespace strata::scene
