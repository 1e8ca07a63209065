#include "shaders_cpu/cloud_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "shaders_cpu/cloud_crossing.h"

namespace strata::shaders {

namespace {

// Seen or lit at a grazing angle a layer is not endlessly deep: clouds are not much wider than they are high.
constexpr double kLeastCosine = 0.1;

// Light goes through a cloud on its way from the sun at these heights of its thickness.
constexpr std::array kTaps{1.0 / 6.0, 0.5, 5.0 / 6.0};
constexpr double kMostSideways = 3.0;  // thicknesses, under a low sun

// Deviations that cut the normal distribution into eight parts of equal probability, in the middle of each.
constexpr std::array kNormalParts{-1.5341, -0.8871, -0.4888, -0.1573, 0.1573, 0.4888, 0.8871, 1.5341};

struct Shown {
    double opacity = 0.0;
    glm::vec3 radiance{0.0f};  // times opacity
};

double opacity_of(double depth, double cosine) {
    return -std::expm1(-depth / std::max(std::abs(cosine), kLeastCosine));
}

glm::dvec2 wind_of(const scene::CloudLayer& layer) {
    const double towards = glm::radians(layer.wind_deg);
    return layer.wind_m_s * glm::dvec2(std::cos(towards), std::sin(towards));
}

glm::vec3 white_under(const glm::dvec3& lux) { return glm::vec3(lux * (std::numbers::inv_pi / kLuminanceOfOne)); }

}  // namespace

CloudScene::CloudScene(const scene::Scene& scene, const DaylightScene& daylight, const glm::dvec3& to_sun)
    : daylight_(&daylight),
      metres_(scene.scale.metres),
      altitude_(scene.sky.altitude_m),
      radius_(kEarthRadius + scene.sky.altitude_m),
      gain_(scene.sky.gain),
      to_sun_(to_sun) {
    for (const scene::CloudLayer& layer : scene.clouds) {
        if (layer.is_there())
            layers_.push_back({layer.altitude_m, layer.thickness_m, CloudField(layer), wind_of(layer), layer.shadow});
    }
    std::ranges::stable_sort(layers_, std::greater(), &Layer::altitude);
    const Daylight& tables = daylight.tables();
    const glm::dvec3 up{0.0, 1.0, 0.0};
    above_ = white_under(tables.sky_irradiance(up) + tables.ground_irradiance(up));
    below_ = white_under(tables.sky_irradiance(-up) + tables.ground_irradiance(-up));
    const auto radiance = [&](const glm::dvec3& direction) {
        const MediumRay ray{glm::dvec3(0.0), direction, std::numeric_limits<double>::infinity()};
        return glm::dvec3(mean_along(ray).over(daylight_->sky(direction)));
    };
    cloudy_.emplace(radiance, 0.0, 1.0);
}

// Light from the sun or, where that has set, none.
float CloudScene::sunlight(const glm::dvec3& x, const glm::dvec3& to_sun, double time) const {
    double clear = 1.0;
    const double y = x.y * metres_;
    for (const Layer& layer : layers_) {
        if (layer.shadow == 0.0) continue;
        const CloudCrossings crossings = cloud_crossings(radius_ + y, to_sun.y, layer.altitude - y);
        for (std::size_t i = 0; i < crossings.count; ++i) {
            const double s = crossings.at[i];
            const double climb = (to_sun.y * (radius_ + y) + s) / (radius_ + layer.altitude);
            const glm::dvec2 plan =
                metres_ * glm::dvec2(x.x, x.z) + s * glm::dvec2(to_sun.x, to_sun.z) - time * layer.wind;
            const double through = std::exp(-layer.field.depth_at(plan) / std::max(std::abs(climb), kLeastCosine));
            clear *= layer.shadow == 1.0 ? through : 1.0 + layer.shadow * (through - 1.0);
        }
    }
    return static_cast<float>(clear);
}

// The sphere at the sea's level ends what is seen of the sky.
double CloudScene::farthest(const MediumRay& ray) const {
    const double y = ray.origin.y * metres_;
    double end = ray.distance * metres_;
    if (ray.direction.y < 0.0 && y > -altitude_) {
        const CloudCrossings sea = cloud_crossings(radius_ + y, ray.direction.y, -altitude_ - y);
        if (sea.count > 0) end = std::min(end, sea.at[0]);
    }
    return end;
}

template <class Visit>
void CloudScene::visit_crossings(const MediumRay& ray, CloudSide side, bool is_mean, const Visit& visit) const {
    const double y = ray.origin.y * metres_, start = radius_ + y, end = farthest(ray);
    const auto look = [&](const Layer& layer) {
        const CloudCrossings crossings = cloud_crossings(start, ray.direction.y, layer.altitude - y);
        for (std::size_t i = 0; i < crossings.count; ++i) {
            const double s = crossings.at[i], out = radius_ + layer.altitude;
            const double climb = (ray.direction.y * start + s) / out;
            if (s > end || (climb > 0.0) != (side == CloudSide::below)) continue;
            const glm::dvec3 up = (s * ray.direction + glm::dvec3(0.0, start, 0.0)) / out;
            const double cosine = std::max(std::abs(climb), kLeastCosine);
            visit(layer, Place{.distance = s,
                               .plan = metres_ * glm::dvec2(ray.origin.x, ray.origin.z) +
                                       s * glm::dvec2(ray.direction.x, ray.direction.z) - ray.time * layer.wind,
                               .climb = climb,
                               .sun_height = glm::dot(up, to_sun_),
                               .footprint = ray.pixel * s / std::sqrt(cosine),
                               .is_mean = is_mean});
        }
    };
    if (side == CloudSide::below) {
        for (const Layer& layer : layers_) look(layer);
    } else {
        for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer) look(*layer);
    }
}

CloudSky CloudScene::sky_at(double altitude, const glm::dvec3& x) const {
    return {daylight_->sun_on_white(altitude / metres_) * daylight_->sun_over_ridges(x), above_, below_};
}

void CloudScene::see(const Layer& layer, const MediumRay& ray, const Place& place, MediumSegment& segment) const {
    const CloudSight sight{.from_below = place.climb > 0.0,
                           .sun_is_beyond = (place.climb > 0.0) == (place.sun_height > 0.0),
                           .sun_cosine = std::max(std::abs(place.sun_height), kLeastCosine),
                           .cosine_turn = glm::dot(ray.direction, to_sun_)};
    const glm::dvec2 level(to_sun_.x, to_sun_.z);
    const double sideways = std::min(1.0 / sight.sun_cosine, kMostSideways) * layer.thickness;
    FilteredValue own = layer.field.mean_excess();
    std::array<double, kTaps.size()> towards_sun;
    towards_sun.fill(own.value);
    if (!place.is_mean) {
        own = layer.field.excess(place.plan, place.footprint);
        if (own.variance == 0.0 && own.value <= 0.0) return;
        const double blur = std::max(place.footprint, 0.25 * sideways);
        for (std::size_t i = 0; i < kTaps.size(); ++i)
            towards_sun[i] = layer.field.excess(place.plan + kTaps[i] * sideways * level, blur).value;
    }

    // Of a sight that is not told apart, the mean of eight equal parts of what it may be.
    const bool is_sharp = own.variance == 0.0;
    const std::size_t parts = is_sharp ? 1 : kNormalParts.size();
    const CloudSky sky = sky_at(layer.altitude, ray.origin + place.distance / metres_ * ray.direction);
    Shown shown;
    for (std::size_t part = 0; part < parts; ++part) {
        const double more = is_sharp ? 0.0 : kNormalParts[part] * std::sqrt(own.variance);
        const double depth = layer.field.depth(own.value + more);
        if (depth == 0.0) continue;
        double sun_depth = 0.0;
        for (const double tap : towards_sun) sun_depth += layer.field.depth(tap + more) / kTaps.size();
        const double opacity = opacity_of(depth, place.climb) / static_cast<double>(parts);
        shown.opacity += opacity;
        shown.radiance += static_cast<float>(opacity) * cloud_radiance(sky, sight, depth, sun_depth);
    }
    if (shown.opacity == 0.0) return;
    const auto opaque = static_cast<float>(shown.opacity);
    const MediumSegment air = daylight_->air_along(ray.direction, place.distance / metres_);
    const MediumSegment cloud{.transmittance = glm::vec3(1.0f - opaque),
                              .inscatter = shown.radiance * air.transmittance + air.inscatter * opaque};
    segment = {.transmittance = segment.transmittance * cloud.transmittance,
               .inscatter = cloud.over(segment.inscatter)};
}

MediumSegment CloudScene::side_along(const MediumRay& ray, CloudSide side, bool is_mean) const {
    MediumSegment segment;
    visit_crossings(ray, side, is_mean,
                    [&](const Layer& layer, const Place& place) { see(layer, ray, place, segment); });
    return segment;
}

MediumSegment CloudScene::along(const MediumRay& ray, CloudSide side) const { return side_along(ray, side, false); }

MediumSegment CloudScene::mean_along(const MediumRay& ray) const {
    const MediumSegment behind = side_along(ray, CloudSide::below, true);
    const MediumSegment before = side_along(ray, CloudSide::above, true);
    return {.transmittance = behind.transmittance * before.transmittance, .inscatter = before.over(behind.inscatter)};
}

double CloudScene::opacity(const MediumRay& ray) const {
    const float clear = along(ray, CloudSide::below).transmittance.x * along(ray, CloudSide::above).transmittance.x;
    return 1.0 - static_cast<double>(clear);
}

glm::vec3 CloudScene::sky_on_white(const glm::dvec3& normal) const {
    const glm::dvec3 ground = daylight_->tables().ground_irradiance(normal) / kLuminanceOfOne;
    return glm::vec3((cloudy_->at(normal) + ground) * (gain_ * std::numbers::inv_pi));
}

}  // namespace strata::shaders
