#include "src/image/colour_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/image/luminance.h"
#include "src/image/srgb.h"
#include "src/scene/enum_names.h"
#include "src/scene/keys.h"

namespace strata::image {
namespace {

// Beyond these limits every code is already 0 or the largest; within them no factor is 0 or infinite.
constexpr double kMostStops = 1000.0;

// Far beyond all that any curve tells from infinite, and small enough for sums and products to stay finite.
constexpr double kMostLight = 1e60;

glm::dvec3 factor_of(const ColourOut& colour) {
    return std::exp2(std::clamp(colour.exposure, -kMostStops, kMostStops)) * colour.white_balance;
}

// Reinhard et al., "Photographic Tone Reproduction for Digital Images" (2002), equation (3), L / (1 + L), with the key
// at which mid grey stays mid grey: L / (L + 1 - 0.18). It is the luminance's, so that hue and saturation stay; what
// then has a channel beyond 1 is mixed with the grey of its luminance until the channel is 1, and the brighter it is,
// the nearer that is to white.
glm::dvec3 reinhard(const glm::dvec3& light) {
    const double factor = 1.0 / (luminance(light) + (1.0 - kMidGrey));
    const glm::dvec3 c = light * factor;
    const double grey = luminance(light) * factor;
    const double top = std::max({c.r, c.g, c.b});
    if (!(top > 1.0)) return c;
    return grey + (c - grey) * ((1.0 - grey) / (top - grey));
}

}  // namespace

ColourOut colour_out(const scene::Film& film) {
    return {.exposure = film.exposure,
            .tone = film.tone,
            .white_balance = film.white_balance,
            .saturation = film.saturation,
            .contrast = film.contrast};
}

std::optional<std::string> problem_of(const ColourOut& colour) {
    if (!std::isfinite(colour.exposure)) return fmt::format("an exposure of {} stops", colour.exposure);
    const glm::dvec3& w = colour.white_balance;
    const scene::Range balance = scene::kWhiteBalance;
    for (int c = 0; c < 3; ++c) {
        if (!(w[c] >= balance.min && w[c] <= balance.max))
            return fmt::format("a white balance of {}, {}, {}", w.r, w.g, w.b);
    }
    if (!(colour.saturation >= scene::kSaturation.min && colour.saturation <= scene::kSaturation.max))
        return fmt::format("a saturation of {}", colour.saturation);
    if (!(colour.contrast >= scene::kContrast.min && colour.contrast <= scene::kContrast.max))
        return fmt::format("a contrast of {}", colour.contrast);
    return std::nullopt;
}

std::optional<std::string> obstacle_to_light(const ColourOut& colour) {
    if (colour.tone != scene::ToneCurve::none) return fmt::format("the tone curve {}", scene::name_of(colour.tone));
    if (colour.saturation != 1.0) return fmt::format("a saturation of {}", colour.saturation);
    return std::nullopt;
}

glm::dvec3 light_of_white(const ColourOut& colour) { return std::exp2(-colour.exposure) / colour.white_balance; }

ColourEncoder::ColourEncoder(const ColourOut& colour)
    : factor_(factor_of(colour)), tone_(colour.tone), saturation_(colour.saturation), agx_(colour.contrast) {}

glm::dvec3 ColourEncoder::displayed(glm::dvec3 light) const {
    if (tone_ == scene::ToneCurve::agx) return agx_.displayed(glm::max(light, 0.0), saturation_);
    if (saturation_ != 1.0) light = saturated(light, saturation_);
    return tone_ == scene::ToneCurve::reinhard ? reinhard(glm::max(light, 0.0)) : light;
}

glm::dvec3 ColourEncoder::operator()(const float* rgb) const {
    glm::dvec3 light;
    for (int c = 0; c < 3; ++c) light[c] = std::clamp(rgb[c] * factor_[c], -kMostLight, kMostLight);
    const glm::dvec3 shown = displayed(light);
    return {encode_srgb(shown.r), encode_srgb(shown.g), encode_srgb(shown.b)};
}

}  // namespace strata::image
