#include "shaders_cpu/daylight/daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace strata::shaders {
namespace {

constexpr int kSunHeights = 257;  // as the fourth power: 35 m apart at 250 m, 190 m at 2500
constexpr double kLowest = -1000.0;

SkyFrame checked_frame(const glm::dvec3& sun, double height) {
    const double length = glm::length(sun);
    // Negated comparisons would let NaN pass.
    if (!(std::fabs(length - 1.0) <= 1e-3))
        throw std::invalid_argument(fmt::format("daylight: sun_direction has length {}; allowed: 1", length));
    if (!(height >= kLowest && height <= kAirTop))
        throw std::invalid_argument(
            fmt::format("daylight: observer_height = {}; allowed: [{}, {}] metres", height, kLowest, kAirTop));
    return {sun / length, std::max(height, 0.0)};
}

std::vector<glm::vec3> tabulate_sun(const AirModel& medium, double sun_up) {
    std::vector<glm::vec3> table(kSunHeights);
    for (int i = 0; i < kSunHeights; ++i) {
        const double x = static_cast<double>(i) / (kSunHeights - 1);
        const Sunlight light = sunlight(medium, kAirTop * x * x * x * x, sun_up);
        table[i] = glm::vec3(glm::max(to_rgb(light.full), glm::dvec3(0.0)));
    }
    return table;
}

glm::dvec3 direction_at(const DirectionBatch& directions, std::size_t i) {
    return {directions.x[i], directions.y[i], directions.z[i]};
}

void put(const glm::dvec3& rgb, const ColourBatch& to, std::size_t i) {
    to.r[i] = static_cast<float>(rgb.r);
    to.g[i] = static_cast<float>(rgb.g);
    to.b[i] = static_cast<float>(rgb.b);
}

}  // namespace

Daylight::Daylight(const Atmosphere& atmosphere, const glm::dvec3& sun_direction, double observer_height)
    : frame_(checked_frame(sun_direction, observer_height)),
      light_(atmosphere),
      sky_(light_, frame_),
      aerial_(light_, frame_),
      sky_irradiance_([&](const glm::dvec3& d) { return sky_radiance(d); }, sky_.horizon(), 1.0),
      ground_irradiance_([&](const glm::dvec3& d) { return sky_radiance(d); }, -1.0, sky_.horizon()),
      sampler_([&](const glm::dvec3& d) { return luminance(sky_radiance(d)); }),
      sun_by_height_(tabulate_sun(light_.medium(), frame_.sun.y)) {}

glm::dvec3 Daylight::sky_radiance(const glm::dvec3& d) const {
    return sky_.radiance(light_.medium(), frame_.locate(d.x, d.y, d.z));
}

void Daylight::sky_radiance(const DirectionBatch& directions, const ColourBatch& radiance) const {
    for (std::size_t i = 0; i < directions.x.size(); ++i) put(sky_radiance(direction_at(directions, i)), radiance, i);
}

glm::dvec3 Daylight::sun_illuminance(double height) const {
    const Cell cell = cell_of(fourth_root(std::max(height, 0.0) / kAirTop), kSunHeights);
    return glm::dvec3(blend(sun_by_height_[cell.index], sun_by_height_[cell.index + 1], cell.fraction));
}

AerialPerspective Daylight::aerial(double height, const glm::dvec3& d, double distance) const {
    return integrate_aerial(light_, std::clamp(height, 0.0, kAirTop), frame_.sun.y, frame_.locate(d.x, d.y, d.z),
                            distance);
}

AerialPerspective Daylight::aerial_from_observer(const glm::dvec3& d, double distance) const {
    if (frame_.height > AerialTable::kHighest) return aerial(frame_.height, d, distance);
    return aerial_.at(light_.medium(), frame_.locate(d.x, d.y, d.z), distance);
}

void Daylight::aerial_from_observer(const DirectionBatch& directions, std::span<const float> distances,
                                    const ColourBatch& transmittance, const ColourBatch& inscatter) const {
    assert(distances.size() == directions.x.size());
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const AerialPerspective air = aerial_from_observer(direction_at(directions, i), distances[i]);
        put(air.transmittance, transmittance, i);
        put(air.inscatter, inscatter, i);
    }
}

}  // namespace strata::shaders
