// What the air sends along a line of sight: the one integral that sky, twilight and aerial perspective are made of.
#pragma once

#include "shaders_cpu/daylight/air_path.h"
#include "shaders_cpu/daylight/scattered_light.h"
#include "shaders_cpu/daylight/sun_table.h"

namespace strata::shaders {

// Radiance, of which a part varies slowly with direction, and one has haze's lobe about the sun: in all
// even + lobe * haze_lobe(cosine to the sun). Kept apart, both can be interpolated.
struct AirRadiance {
    Bands even{0.0}, lobe{0.0};

    AirRadiance& operator+=(const AirRadiance& more) {
        even += more.even;
        lobe += more.lobe;
        return *this;
    }
};

class AirLight {
  public:
    static constexpr int kOrders = 4;
    static constexpr int kPathSteps = 64;

    explicit AirLight(const Atmosphere& atmosphere, int scattered_orders = kOrders,
                      ScatteredLight::Rest rest = ScatteredLight::Rest::kSeries);

    // One step's. `sun_up` is the sun's cosine to the vertical of the path's start and `cosine` that to its direction.
    AirRadiance of_step(const AirPath& path, const AirStep& step, double sun_up, double cosine) const;

    AirRadiance of_path(const AirPath& path, double sun_up, double cosine) const;

    // The path must end at the ground: what the ground there adds.
    Bands of_ground(const AirPath& path, double sun_up, double cosine) const;

    // All that comes from a direction, from an infinite distance or the ground.
    AirRadiance of_sky(double height, double up, double sun_up, double cosine) const;

    Bands total(const AirRadiance& light, double cosine) const {
        return light.even + light.lobe * medium_.haze_lobe(cosine);
    }

    const AirModel& medium() const { return medium_; }

  private:
    AirModel medium_;
    SunTable sun_;
    ScatteredLight scattered_;
};

}  // namespace strata::shaders
