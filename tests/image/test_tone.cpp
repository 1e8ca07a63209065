#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <random>
#include <vector>

#include "src/image/canvas.h"
#include "src/image/colour_out.h"
#include "src/image/dither.h"
#include "src/image/image_error.h"
#include "src/image/luminance.h"
#include "src/image/read.h"
#include "src/image/srgb.h"
#include "src/image/write.h"
#include "src/scene/enum_names.h"
#include "tests/image/scratch_folder.h"

using namespace strata;
using namespace strata::image;
using scene::ToneCurve;

namespace {

constexpr std::array<ToneCurve, 2> kCurves{ToneCurve::reinhard, ToneCurve::agx};

ColourOut with(ToneCurve tone, double contrast = 1.0, double saturation = 1.0) {
    return {.tone = tone, .saturation = saturation, .contrast = contrast};
}

glm::dvec3 encoded(const ColourOut& colour, float r, float g, float b) {
    const std::array<float, 3> rgb{r, g, b};
    return ColourEncoder(colour)(rgb.data());
}

double grey(const ColourOut& colour, double light) {
    const auto value = static_cast<float>(light);
    return encoded(colour, value, value, value).r;
}

// Degrees of the colour circle; of a colour that is no grey.
double hue_deg(const glm::dvec3& c) {
    return glm::degrees(std::atan2(std::sqrt(3.0) * (c.g - c.b), 2 * c.r - c.g - c.b));
}

double largest(const glm::dvec3& c) { return std::max({c.r, c.g, c.b}); }
double smallest(const glm::dvec3& c) { return std::min({c.r, c.g, c.b}); }

double hue_change_deg(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

Picture random_picture() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> stops(-14.0f, 6.0f);
    Picture picture = make_picture(61, 17);
    for (float& v : picture.rgb) v = std::exp2(stops(random)) - 0.001f;
    return picture;
}

}  // namespace

TEST_CASE("without a tone curve codes are those of the light times 2^exposure, bit for bit") {
    const ScratchFolder folder;
    const Picture picture = random_picture();
    for (const double exposure : {0.0, 1.0, -2.37}) {
        const WriteOptions options{.colour = {.exposure = exposure}};
        write_picture(folder / "a.tif", picture, {}, options);
        write_picture(folder / "a.png", picture, {}, options);
        const Picture tiff = read_picture(folder / "a.tif"), png = read_picture(folder / "a.png");
        int wrong = 0;
        for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
            const double value = encode_srgb(picture.rgb[i] * std::exp2(exposure));
            const int x = static_cast<int>(i / 3 % 61), y = static_cast<int>(i / 3 / 61);
            if (std::lround(tiff.rgb[i] * 65535.0) != std::lround(value * 65535.0)) ++wrong;
            if (std::lround(png.rgb[i] * 255.0) != dithered_code(value, x, y)) ++wrong;
        }
        CHECK_MESSAGE(wrong == 0, "at " << exposure << " stops");
    }
}

TEST_CASE("curves leave black black and mid grey where it is, and bring what is bright enough to white") {
    for (const ToneCurve tone : kCurves) {
        for (const double contrast : {0.7, 1.0, 2.0}) {
            const ColourOut colour = with(tone, contrast);
            CHECK(grey(colour, 0.0) == 0.0);
            CHECK(grey(colour, -1.0) == 0.0);
            CHECK(grey(colour, kMidGrey) == doctest::Approx(encode_srgb(kMidGrey)).epsilon(1e-6));
            CHECK(grey(colour, 1e9) > 1.0 - 1e-8);
        }
    }
}

TEST_CASE("a brighter grey is never shown darker, and grey light is shown grey") {
    std::vector<ColourOut> colours;
    for (const double saturation : {0.0, 1.0, 2.0}) {
        colours.push_back(with(ToneCurve::none, 1.0, saturation));
        for (const double contrast : {0.7, 1.0, 2.0}) {
            for (const ToneCurve tone : kCurves) colours.push_back(with(tone, contrast, saturation));
        }
    }
    for (const ColourOut& colour : colours) {
        const ColourEncoder encode(colour);
        double before = 0.0;
        int falls = 0, coloured = 0;
        for (double stops = -20.0; stops < 20.0; stops += 1.0 / 128) {
            const auto light = static_cast<float>(std::exp2(stops));
            const std::array<float, 3> rgb{light, light, light};
            const glm::dvec3 shown = encode(rgb.data());
            // What codes can tell: arithmetic may be off by some last bits, of saturation or of a curve that is flat.
            if (shown.r < before - 1e-12) ++falls;
            if (std::max(std::abs(shown.r - shown.g), std::abs(shown.r - shown.b)) > 1e-12) ++coloured;
            before = shown.r;
        }
        CHECK_MESSAGE(falls == 0, scene::name_of(colour.tone) << ", contrast " << colour.contrast);
        CHECK_MESSAGE(coloured == 0, scene::name_of(colour.tone) << ", saturation " << colour.saturation);
        CHECK(before > 0.99);
    }
}

TEST_CASE("exposure is light: a stop more is twice the light, with every curve") {
    for (const ToneCurve tone : kCurves) {
        ColourOut brighter = with(tone);
        brighter.exposure = 3.0;
        CHECK(encoded(brighter, 0.05f, 0.5f, 0.25f) == encoded(with(tone), 0.4f, 4.0f, 2.0f));
        ColourOut warmer = with(tone);
        warmer.white_balance = {2.0, 1.0, 0.5};
        CHECK(encoded(warmer, 0.05f, 0.5f, 0.25f) == encoded(with(tone), 0.1f, 0.5f, 0.125f));
    }
}

TEST_CASE(
    "bright saturated light goes to white and never changes the order of its channels, so that hues do not flip") {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> amount(-9.0, 0.0);
    for (const ToneCurve tone : kCurves) {
        double worst_deg = 0.0, worst_vivid_deg = 0.0;
        int flips = 0, coloured = 0;
        for (int k = 0; k < 500; ++k) {
            glm::dvec3 hue(std::exp2(amount(random)), std::exp2(amount(random)), std::exp2(amount(random)));
            if (k < 6) hue = {k & 1 || k == 0 ? 1.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? 1.0 : 0.0};
            for (double stops = -8.0; stops <= 24.0; stops += 0.5) {
                const glm::dvec3 light = hue * std::exp2(stops);
                const auto r = static_cast<float>(light.r), g = static_cast<float>(light.g),
                           b = static_cast<float>(light.b);
                const glm::dvec3 shown = encoded(with(tone), r, g, b);
                for (int c = 0; c < 3; ++c) {
                    const int d = (c + 1) % 3;
                    if ((light[c] - light[d]) * (shown[c] - shown[d]) < -1e-12) ++flips;
                }
                const glm::dvec3 seen(decode_srgb(shown.r), decode_srgb(shown.g), decode_srgb(shown.b));
                // Below the first chroma the hue of what is nearly white, grey or black is not seen.
                const double chroma = largest(seen) - smallest(seen),
                             change_deg = hue_change_deg(hue_deg(light), hue_deg(seen));
                if (chroma > 0.02) worst_deg = std::max(worst_deg, change_deg);
                if (chroma > 0.4) worst_vivid_deg = std::max(worst_vivid_deg, change_deg);
            }
            const glm::dvec3 blinding = hue * 1e9;
            const glm::dvec3 white = encoded(with(tone), static_cast<float>(blinding.r), static_cast<float>(blinding.g),
                                             static_cast<float>(blinding.b));
            if (smallest(white) < 0.99) ++coloured;
        }
        CHECK_MESSAGE(flips == 0, scene::name_of(tone));
        CHECK_MESSAGE(coloured == 0, scene::name_of(tone));
        // A sixth of the circle is what equal order allows, and what agx makes of tints on the way to white; vivid
        // colours turn two thirds as far at most. Reinhard's curve is the luminance's and keeps hues.
        const bool turns = tone == ToneCurve::agx;
        const double bound_deg = turns ? 60.0 : 1e-3, vivid_bound_deg = turns ? 40.0 : 1e-3;
        MESSAGE(std::string(scene::name_of(tone)) << ", hue, observed / bound: " << worst_deg / bound_deg << ", vivid "
                                                  << worst_vivid_deg / vivid_bound_deg);
        CHECK(worst_deg < bound_deg);
        CHECK(worst_vivid_deg < vivid_bound_deg);
    }
}

TEST_CASE("all finite light has a code, and always the same one") {
    constexpr float kMost = std::numeric_limits<float>::max(), kLeast = std::numeric_limits<float>::denorm_min();
    const std::array<float, 11> values{-kMost, -1.0f, -kLeast, -0.0f, 0.0f, kLeast, 1e-30f, 0.18f, 16.3f, 1e30f, kMost};
    for (const ToneCurve tone : {ToneCurve::none, ToneCurve::reinhard, ToneCurve::agx}) {
        for (const double exposure : {0.0, 64.0, -64.0, 1e9, -1e9}) {
            for (const double saturation : {0.0, 1.0, 2.0}) {
                ColourOut colour = with(tone, 2.0, saturation);
                colour.exposure = exposure;
                int wrong = 0;
                for (const float r : values) {
                    for (const float g : values) {
                        for (const float b : values) {
                            const glm::dvec3 shown = encoded(colour, r, g, b);
                            for (int c = 0; c < 3; ++c) wrong += shown[c] >= 0.0 && shown[c] <= 1.0 ? 0 : 1;
                            wrong += shown == encoded(colour, r, g, b) ? 0 : 1;
                        }
                    }
                }
                CHECK_MESSAGE(wrong == 0, scene::name_of(tone) << " at " << exposure << ", " << saturation);
            }
        }
    }
}

TEST_CASE("saturation 0 shows greys, and more saturation more chroma at the same luminance") {
    for (const ToneCurve tone : {ToneCurve::none, ToneCurve::reinhard, ToneCurve::agx}) {
        const glm::dvec3 none = encoded(with(tone, 1.0, 0.0), 0.3f, 0.2f, 0.1f);
        CHECK(largest(none) - smallest(none) < 1e-12);
        double before = 0.0;
        for (const double saturation : {0.25, 0.5, 1.0, 1.5, 2.0}) {
            const glm::dvec3 shown = encoded(with(tone, 1.0, saturation), 0.3f, 0.2f, 0.1f);
            CHECK(largest(shown) - smallest(shown) > before);
            before = largest(shown) - smallest(shown);
        }
    }
    const glm::dvec3 light = {0.3, 0.2, 0.1};
    CHECK(luminance(saturated(light, 1.7)) == doctest::Approx(luminance(light)).epsilon(1e-14));
}

TEST_CASE("a canvas, a PNG and a TIFF show the same colours, whatever the crop, and EXR keeps the light") {
    const ScratchFolder folder;
    const Picture picture = random_picture();
    for (const ToneCurve tone : kCurves) {
        ColourOut colour = with(tone, 1.2, 1.3);
        colour.exposure = 0.7;
        colour.white_balance = {1.1, 1.0, 0.9};
        write_picture(folder / "a.png", picture, {}, {.colour = colour});
        write_picture(folder / "a.tif", picture, {}, {.colour = colour});
        write_picture(folder / "a.exr", picture, {}, {.colour = colour, .exr_format = ExrFormat::floating});
        const Picture png = read_picture(folder / "a.png"), tiff = read_picture(folder / "a.tif");
        CHECK(to_canvas(picture, colour).rgb == png.rgb);
        double farthest = 0.0;
        for (std::size_t i = 0; i < png.rgb.size(); ++i)
            farthest = std::max<double>(farthest, std::abs(png.rgb[i] - tiff.rgb[i]));
        CHECK(farthest < 1.01 / 255);
        CHECK(read_picture(folder / "a.exr").rgb == picture.rgb);
        CHECK(read_linear(folder / "a.exr", colour).rgb == picture.rgb);
    }
}

TEST_CASE("codes behind a curve or a saturation are refused as light, those of a white balance are light again") {
    const ScratchFolder folder;
    Picture picture = make_picture(1, 1);
    picture.rgb = {0.2f, 0.3f, 0.4f};
    ColourOut colour{.exposure = 0.5, .white_balance = {1.2, 0.9, 0.7}};
    write_picture(folder / "a.tif", picture, {}, {.colour = colour});
    const Picture light = read_linear(folder / "a.tif", colour);
    for (std::size_t c = 0; c < 3; ++c) CHECK(light.rgb[c] == doctest::Approx(picture.rgb[c]).epsilon(1e-4));
    const auto refusal = [&](const ColourOut& written_with) -> std::string {
        try {
            read_linear(folder / "a.tif", written_with);
        } catch (const ImageError& error) {
            return error.what();
        }
        return {};
    };
    CHECK(refusal(with(ToneCurve::agx)).find("the tone curve agx is in its codes") != std::string::npos);
    CHECK(refusal(with(ToneCurve::reinhard)).find("the tone curve reinhard is in its codes") != std::string::npos);
    CHECK(refusal(with(ToneCurve::none, 1.0, 0.5)).find("a saturation of 0.5 is in its codes") != std::string::npos);
}

TEST_CASE("colours that no scene may ask for are refused before a picture is written") {
    const auto problem = [](const ColourOut& colour) { return problem_of(colour).value_or(""); };
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    CHECK(problem({}).empty());
    CHECK(problem({.exposure = kNan}).find("exposure") != std::string::npos);
    CHECK(problem({.white_balance = {1.0, 0.0, 1.0}}).find("white balance of 1, 0, 1") != std::string::npos);
    CHECK(problem({.saturation = 2.1}).find("saturation of 2.1") != std::string::npos);
    CHECK(problem({.contrast = kNan}).find("contrast") != std::string::npos);
    const ScratchFolder folder;
    CHECK_THROWS_AS(write_picture(folder / "a.png", make_picture(1, 1), {}, {.colour = {.contrast = 0.5}}), ImageError);
}
