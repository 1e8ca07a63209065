#include "shaders_cpu/media/fog.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "noise/reference.h"
#include "shaders_cpu/sky.h"

namespace strata::shaders {

namespace {

constexpr double kContrastLeft = 3.912;  // -ln 0.02: Koschmieder's visibility is that many optical depths
// Nothing is looked at further than this, metres: over such a distance the ground has curved out of any fog.
constexpr double kFarthest = 100e3;
constexpr double kHeights = 6.0;  // above the top by so many fall_m the noise matters no more: a 400th is left

double henyey_greenstein(double cosine, double g) {
    const double denominator = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (4.0 * std::numbers::pi * denominator * std::sqrt(denominator));
}

std::vector<noise::Octave> waves_of(const scene::Fog& fog, double metres) {
    if (fog.rise_m <= 0.0) return {};
    return noise::make_octaves({.octaves = 2,
                                .lacunarity = 3.2,
                                .gain = 0.4,
                                .amplitude = fog.rise_m,
                                .frequency = metres / fog.patch_m,
                                .seed = 2});
}

}  // namespace

Fog::Fog(const ShaderInputs& inputs)
    : fog_(inputs.scene.fog),
      metres_(inputs.scene.scale.metres),
      density_(kContrastLeft / inputs.scene.fog.visibility_m),
      waves_(waves_of(inputs.scene.fog, metres_)),
      to_sun_(glm::normalize(inputs.scene.sun.direction)),
      daylight_(inputs.daylight),
      clouds_(inputs.clouds),
      haze_(Haze::is_in(inputs.scene) ? std::optional<Haze>(inputs) : std::nullopt),
      sun_(inputs.scene.sun.colour * (inputs.scene.sun.intensity * std::numbers::inv_pi)),
      sky_(0.5f * (ambient_light(inputs.scene.sky, 1.0) + ambient_light(inputs.scene.sky, -1.0))) {}

// density * integral over 0..length of exp(-(y + climb s - level) / fall); all in metres. With u = climb length / fall
// it is density * length * exp(-(y - level) / fall) * (1 - exp(-u)) / u. The exponential is taken at the lower end of
// the two, so that nothing overflows but where the fog is that thick.
double Fog::even_depth(double y, double climb, double length, double level) const {
    const double lowest = climb < 0.0 ? y + climb * length : y;
    const double u = std::abs(climb) * length / fog_.fall_m;
    const double mean = u > 1e-8 ? -std::expm1(-u) / u : 1.0 - 0.5 * u;
    return density_ * length * std::exp(-(lowest - level) / fog_.fall_m) * mean;
}

// The noise's height at a place, metres. Waves shorter than the stretch that it stands for fade.
double Fog::lift(const glm::dvec3& x, double step) const {
    double sum = 0.0;
    for (const noise::Octave& octave : waves_) {
        const double cells = octave.frequency * step;
        const noise::Point<2> p{octave.frequency * x.x + octave.offset[0], octave.frequency * x.z + octave.offset[1]};
        sum += octave.amplitude / (1.0 + cells * cells) *
               noise::reference_value<2>(octave.key, noise::split_position<2>(p));
    }
    return sum;
}

// What lies before, within and behind the stretch on which the ray is low enough for the noise to matter.
std::array<Fog::Piece, Fog::kPieces + 2> Fog::pieces(const MediumRay& ray) const {
    const double y = ray.origin.y * metres_, climb = ray.direction.y;
    const double length = std::min(ray.distance * metres_, kFarthest);
    const double top = fog_.level_m + fog_.rise_m + kHeights * fog_.fall_m;
    double begin = 0.0, end = length;
    if (climb < 0.0) begin = std::clamp((top - y) / climb, 0.0, length);
    if (climb > 0.0) end = std::clamp((top - y) / climb, 0.0, length);
    if (climb == 0.0 && y > top) end = 0.0;
    std::array<Piece, kPieces + 2> all;
    all.front() = {0.0, begin, false};
    for (std::size_t i = 0; i < kPieces; ++i) {
        const double step = (end - begin) / static_cast<double>(kPieces);
        all[i + 1] = {begin + static_cast<double>(i) * step, step, true};
    }
    all.back() = {end, length - end, false};
    return all;
}

double Fog::depth_of(const MediumRay& ray, const Piece& piece) const {
    if (piece.length <= 0.0) return 0.0;
    const double climb = ray.direction.y, y = ray.origin.y * metres_ + climb * piece.begin;
    double level = fog_.level_m;
    if (piece.is_lifted && !waves_.empty()) {
        const double across = piece.length / metres_ * std::hypot(ray.direction.x, ray.direction.z);
        level += lift(ray.origin + ((piece.begin + 0.5 * piece.length) / metres_) * ray.direction, across);
    }
    return even_depth(y, climb, piece.length, level);
}

double Fog::depth(const MediumRay& ray) const {
    double sum = 0.0;
    for (const Piece& piece : pieces(ray)) sum += depth_of(ray, piece);
    return sum;
}

float Fog::phase(const glm::dvec3& direction) const {
    return static_cast<float>(std::numbers::pi * henyey_greenstein(glm::dot(direction, to_sun_), fog_.forward));
}

// Radiance of white that faces the sun, which the air takes from as at a height.
glm::vec3 Fog::sun_at(const glm::dvec3& x, double height) const {
    if (daylight_ == nullptr) return sun_;
    return daylight_->sun_on_white(height) * daylight_->sun_over_ridges(x);
}

// Radiance of fog so thick that nothing is seen through it: albedo 1, scattered once from the sun, evenly from the sky.
glm::vec3 Fog::sun_source(const MediumRay& ray) const {
    const double level = fog_.level_m / metres_;
    glm::dvec3 x = ray.origin + std::min(ray.distance, kFarthest / metres_) * ray.direction;
    x.y = std::min(x.y, level);
    return sun_at(x, level) * phase(ray.direction);
}

glm::vec3 Fog::sky_source() const {
    if (daylight_ == nullptr) return sky_;
    const glm::dvec3 up{0.0, 1.0, 0.0};
    return 0.5f * (daylight_->sky_on_white(up) + daylight_->sky_on_white(-up));
}

// What is between the eye and a place in the fog.
MediumSegment Fog::air(const MediumRay& ray, double distance) const {
    const MediumRay part{ray.origin, ray.direction, distance};
    if (daylight_ != nullptr) return daylight_->air_along(part.direction, part.distance);
    return haze_ ? haze_->along(part) : MediumSegment{};
}

// The light that the fog adds comes from where it was scattered, on the mean, and through the air before that.
MediumSegment Fog::along(const MediumRay& ray) const {
    double clear = 1.0, way = 0.0;
    for (const Piece& piece : pieces(ray)) {
        const double left = clear * std::exp(-depth_of(ray, piece));
        way += (clear - left) * (piece.begin + 0.5 * piece.length);
        clear = left;
    }
    const double scattered = 1.0 - clear;
    if (scattered <= 0.0) return {};
    const glm::vec3 source = fog_.shafts ? sky_source() : sun_source(ray) + sky_source();
    const glm::vec3 seen = air(ray, way / scattered / metres_).over(source);
    return {.transmittance = glm::vec3(static_cast<float>(clear)),
            .inscatter = seen * static_cast<float>(scattered) + ray.shaft};
}

// How far into a piece a share of its depth lies. The depth from its lower end up to a height h is
// 1 - exp(-h / fall), of a factor; u is the whole height in falls, of which rounding may find more than there is.
double Fog::way_within(double climb, const Piece& piece, double share) const {
    const double u = std::abs(climb) * piece.length / fog_.fall_m;
    if (u < 1e-8) return share * piece.length;
    const double from_low = climb > 0.0 ? share : 1.0 - share;
    const double part = std::min(-std::log1p(from_low * std::expm1(-u)) / u, 1.0);
    return (climb > 0.0 ? part : 1.0 - part) * piece.length;
}

// The depth before it has the density exp(-depth) / scattered, whose inverse gives it; then it is followed piece by
// piece.
Fog::Shaft Fog::shaft(const MediumRay& ray, double u) const {
    const std::array<Piece, kPieces + 2> all = pieces(ray);
    std::array<double, kPieces + 2> depths{};
    double whole = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) whole += depths[i] = depth_of(ray, all[i]);
    const double scattered = -std::expm1(-whole);
    if (scattered <= 0.0) return {};
    double left = -std::log1p(-u * scattered), way = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (depths[i] <= 0.0) continue;
        way = all[i].begin + way_within(ray.direction.y, all[i], std::min(left / depths[i], 1.0));
        if (left <= depths[i]) break;
        left -= depths[i];
    }
    way /= metres_;
    const glm::dvec3 x = ray.origin + way * ray.direction;
    glm::vec3 sun = sun_at(x, x.y) * (phase(ray.direction) * static_cast<float>(scattered));
    if (clouds_ != nullptr && sun != glm::vec3(0.0f)) sun *= clouds_->sunlight(x, to_sun_, ray.time);
    return {way, air(ray, way).transmittance * sun};
}

}  // namespace strata::shaders
