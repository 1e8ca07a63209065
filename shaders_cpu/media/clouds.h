// Layers of clouds before the eye: thin ones, each all at one height over the Earth. Their shadow on the ground is the
// light's affair (lights/daylight_sun.h); here is how they look, from below and from above.
//
//   altitude_m    over the surface's y = 0                                                2500
//   thickness_m   over which sunlight goes sideways in the clouds                         300
//   coverage      share of the sky where there is cloud                                   0.4
//   depth         optical, `edge` within a cloud; 0: none                                 12
//   edge          how far from its rim that is, root mean squares of the noise            1
//   size_m        cells of the noise's coarsest octave                                    5000
//   stretch       how much longer they are along stretch_deg                              1
//   warp_m        how far another noise bends the plan                                    0
//
//   [sky]
//   model = "daylight"
//   [[clouds]]
//   name = "cumulus"
//   altitude_m = 2600.0
//   coverage = 0.45
//   size_m = 5200.0
//   warp_m = 500.0
#pragma once

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/medium_ray.h"
#include "shaders_cpu/medium_segment.h"
#include "src/scene/needs.h"

namespace strata::shaders {

template <CloudSide kSide>
class Clouds {
  public:
    static constexpr bool kBeforeBackground = true;

    static constexpr auto kName = kSide == CloudSide::below ? "clouds overhead" : "clouds underneath";
    static const char* why(const scene::Scene& scene) {
        if (is_in(scene))
            return "[[clouds]]: layers over the Earth, whose shadows need no rays; each has a noise of its own";
        return scene.clouds.empty() ? "no [[clouds]]" : "all [[clouds]] have coverage or depth 0";
    }

    static bool is_in(const scene::Scene& scene) { return scene::needs_clouds(scene); }

    explicit Clouds(const ShaderInputs& inputs) : clouds_(inputs.clouds) {}

    MediumSegment along(const MediumRay& ray) const { return clouds_->along(ray, kSide); }

  private:
    const CloudScene* clouds_;
};

using CloudsBehind = Clouds<CloudSide::below>;
using CloudsBefore = Clouds<CloudSide::above>;

}  // namespace strata::shaders
