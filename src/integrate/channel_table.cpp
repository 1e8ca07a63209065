// The table of channels: a row each, with the formula of a sample's value.
#include <array>

#include "src/integrate/channels.h"
#include "src/integrate/sample_view.h"

namespace strata::integrate {

namespace {

glm::vec3 scalar(double value) { return {static_cast<float>(value), 0.0f, 0.0f}; }

// Rec. ITU-R BT.709-6, item 3.2.
double luminance(const glm::dvec3& light) { return glm::dot(light, glm::dvec3(0.2126, 0.7152, 0.0722)); }

}  // namespace

std::span<const Channel> all_channels() {
    using enum ChannelType;
    using enum ChannelFilter;
    using shaders::LightLayer;
    using S = SampleView;
    // clang-format off
    static constexpr std::array kTable{
        // name, type, filter, unit, meaning, value of a sample
        Channel{"Z", depth, nearest, "world units",
                "distance of what is seen from the eye along the view axis; 1e10: nothing is hit",
                [](const S& s) { return scalar(s.depth()); }},
        Channel{"depth", number, min, "world units",
                "distance of what is seen from the eye along the ray; 1e10: nothing is hit",
                [](const S& s) { return scalar(s.distance()); }},
        Channel{"P", vector, nearest, "world units",
                "position of what is seen, in the world; 0: nothing is hit",
                [](const S& s) { return glm::vec3(s.position()); }},
        Channel{"N", vector, nearest, "unit vector",
                "normal of what is seen, outward, in the world; 0: nothing is hit",
                [](const S& s) { return glm::vec3(s.normal()); }},
        Channel{"albedo", colour, picture, "linear Rec. 709",
                "reflectance of what is seen; 0: nothing is hit",
                [](const S& s) { return s.reflectance(); }},
        Channel{"sun", colour, picture, "radiance",
                "sunlight from the surface, as the air lets it through; with sky, bounce, water, air, background it is all",
                [](const S& s) { return s.reflected(LightLayer::sun); }},
        Channel{"sky", colour, picture, "radiance",
                "skylight from the surface, as the air lets it through",
                [](const S& s) { return s.reflected(LightLayer::sky); }},
        Channel{"bounce", colour, picture, "radiance",
                "light that other ground, or water, reflected onto the surface, as the air lets it through",
                [](const S& s) { return s.reflected(LightLayer::bounce); }},
        Channel{"water", colour, picture, "radiance",
                "what level water mirrors and lets through from below, as the air lets it through",
                [](const S& s) { return s.water(); }},
        Channel{"air", colour, picture, "radiance",
                "what haze, air, fog or clouds before the surface or water add, and fog and clouds before the sky",
                [](const S& s) { return s.inscatter(); }},
        Channel{"background", colour, picture, "radiance",
                "what is seen where nothing is hit, as fog and clouds let it through",
                [](const S& s) { return s.background(); }},
        Channel{"shadow", number, picture, "share",
                "1: nothing of the surface hides the sun; 0: in shadow, turned away or nothing is hit",
                [](const S& s) { return scalar(s.sun_visibility()); }},
        Channel{"cloud", number, picture, "share",
                "what clouds hide of the surface or the sky behind them",
                [](const S& s) { return scalar(s.cloud_opacity()); }},
        Channel{"height", number, picture, "share",
                "the material's part above band_height",
                [](const S& s) { return scalar(s.height_mask()); }},
        Channel{"slope", number, picture, "share",
                "the material's part that is steep",
                [](const S& s) { return scalar(s.slope_mask()); }},
        Channel{"mask", masks, picture, "share",
                "what each layer of ground covers, where ground is seen",
                nullptr, [](const S& s, std::span<float> values) { s.ground_shares(values); }},
        Channel{"cryptomatte", mattes, ranks, "id and share",
                "the same as a Cryptomatte named crypto_ground: pairs of a layer's id and what it covers",
                nullptr, [](const S& s, std::span<float> values) { s.ground_shares(values); }},
        Channel{"motion", screen, nearest, "pixels a frame",
                "how far what is seen moves until the next frame, to the right and upward",
                [](const S& s) { return glm::vec3(s.motion(), 0.0); }},
        Channel{"samples", number, sum, "samples",
                "samples that the estimator placed for the pixel",
                [](const S&) { return scalar(1.0); }},
        Channel{"variance", number, variance, "squared radiance",
                "variance of the luminance of the pixel's estimate, from its own samples",
                [](const S& s) { return scalar(luminance(glm::dvec3(s.radiance()))); }},
        Channel{"steps", work, mean, "steps a sample",
                "tracer steps a sample, shadow rays' included",
                [](const S& s) { return scalar(static_cast<double>(s.steps())); }},
        Channel{"evals", work, mean, "evaluations a sample",
                "noise evaluations a sample (octaves at points), shadow rays' and normals' included",
                [](const S& s) { return scalar(static_cast<double>(s.noise_evaluations())); }},
    };
    // clang-format on
    return kTable;
}

}  // namespace strata::integrate
