// A straight line through the air, cut into steps.
#pragma once

#include <span>
#include <vector>

#include "shaders_cpu/daylight/atmosphere.h"
#include "shaders_cpu/daylight/grid.h"

namespace strata::shaders {

// Directions are given by `up`, the cosine to the vertical of the point where the line starts, `height` metres above
// the sphere. Below the sphere the air goes on as it is at its surface, so that flat worlds have air along their far
// ground.

// `up` of the horizon, of the sphere and without refraction.
double horizon_up(double height);

// Metres to the sphere; infinity for a line that misses it.
double distance_to_ground(double height, double up);

// Metres to where the line leaves the air, or lies deeper below the sphere than any picture goes.
double distance_to_end(double height, double up);

// Columns (metres of density 1) from the point to the end of the air, along a line that meets no ground.
Densities columns_to_top(const AirModel& medium, double height, double up);

// What scatters, one step of the line's.
struct AirStep {
    double distance;         // from the start to the middle, metres
    double radius, horizon;  // of the middle: to the Earth's centre, and horizon_up() there
    Cell sun_cell, diffuse_cell;
    // Of light that falls on the step, what share of it reaches the start if it is scattered into the line: extinction
    // up to the start and within the step included. Air and the even part of haze for diffuse light, haze for that of
    // its lobe.
    Bands air, even_haze, haze;
    Densities columns;  // from the start to the end of the step
};

class AirPath {
  public:
    // `distance` may be infinite. Steps are short where the line is lowest.
    AirPath(const AirModel& medium, double height, double up, double distance, int steps);

    // Steps from one of the ascending `distances` to the next; of length 0 beyond the end of the air.
    AirPath(const AirModel& medium, double height, double up, std::span<const double> distances);

    std::span<const AirStep> steps() const { return steps_; }
    double start_radius() const { return start_radius_; }
    double length() const { return length_; }
    const Bands& diffuse_transmittance() const { return diffuse_transmittance_; }  // of the whole
    const Densities& columns() const { return columns_; }

  private:
    void add_step(const AirModel& medium, double up, double from, double to);

    double start_radius_, length_;
    std::vector<AirStep> steps_;
    Bands full_transmittance_{1.0}, diffuse_transmittance_{1.0};
    Densities columns_{0.0, 0.0, 0.0};
};

}  // namespace strata::shaders
