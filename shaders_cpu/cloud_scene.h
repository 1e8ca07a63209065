// The clouds of a scene ([[clouds]]): what they hide of the sun, and how they look.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "shaders_cpu/cloud_field.h"
#include "shaders_cpu/cloud_light.h"
#include "shaders_cpu/daylight/sky_irradiance.h"
#include "shaders_cpu/daylight_scene.h"
#include "shaders_cpu/medium_ray.h"
#include "shaders_cpu/medium_segment.h"
#include "src/scene/scene.h"

namespace strata::shaders {

// Clouds that are seen from below stand behind what lies low, such as fog; those seen from above before it.
enum class CloudSide { below, above };

class CloudScene {
  public:
    // to_sun: in the surface's resting axes. The daylight outlives this.
    CloudScene(const scene::Scene& scene, const DaylightScene& daylight, const glm::dvec3& to_sun);

    // The part of the sun's light that arrives straight at a point of the surface, at a time in seconds.
    float sunlight(const glm::dvec3& x, const glm::dvec3& to_sun, double time = 0.0) const;

    // What the clouds that a ray sees from one side do to the light that comes along it, air before them included.
    MediumSegment along(const MediumRay& ray, CloudSide side) const;

    // The same of both sides for a ray that sees no cloud from another: all layers at their mean.
    MediumSegment mean_along(const MediumRay& ray) const;

    // The part of the light behind them that the clouds before a ray's end hide.
    double opacity(const MediumRay& ray) const;

    // DaylightScene::sky_on_white with all layers at their mean before the sky.
    glm::vec3 sky_on_white(const glm::dvec3& normal) const;

  private:
    struct Layer {
        double altitude, thickness;  // metres
        CloudField field;
        glm::dvec2 wind;  // metres a second, in the plan
        double shadow;    // share
    };
    struct Place {
        double distance;    // metres from the eye
        glm::dvec2 plan;    // metres
        double climb;       // of the ray, by the layer's vertical there
        double sun_height;  // sine of the sun's, likewise
        double footprint;   // metres
        bool is_mean;
    };

    // visit(layer, place), along the ray from far to near by layers.
    template <class Visit>
    void visit_crossings(const MediumRay& ray, CloudSide side, bool is_mean, const Visit& visit) const;
    void see(const Layer& layer, const MediumRay& ray, const Place& place, MediumSegment& segment) const;
    MediumSegment side_along(const MediumRay& ray, CloudSide side, bool is_mean) const;
    double farthest(const MediumRay& ray) const;
    CloudSky sky_at(double altitude, const glm::dvec3& x) const;

    const DaylightScene* daylight_;
    double metres_, altitude_, radius_;  // of y = 0
    double gain_;
    glm::dvec3 to_sun_;
    std::vector<Layer> layers_;  // highest first
    glm::vec3 above_, below_;    // radiance of white that faces up, or down
    std::optional<SkyIrradiance> cloudy_;
};

}  // namespace strata::shaders
