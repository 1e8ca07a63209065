#include "src/image/picture_metadata.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "noise/simd_target.h"
#include "src/scene/enum_names.h"
#include "src/scene/needs.h"
#include "src/scene/printer.h"

namespace strata::image {

namespace {

std::string filter_text(const scene::Sampling& sampling) {
    if (scene::row_of(sampling.estimator).is_single) return "none";
    if (scene::row_of(sampling.estimator).is_box()) return "box";
    return fmt::format("B-spline of order {}", sampling.m);
}

// The fraction nearest to a rate, of whole numbers that an EXR has room for. Decimals have up to six digits behind the
// point, but for rates too high to need them.
FrameRate nearest_fraction(double numerator, double denominator) {
    constexpr double kMost = std::numeric_limits<int>::max();
    while (numerator != std::floor(numerator) && denominator < 1e6 && numerator * 10 < kMost) {
        numerator *= 10;
        denominator *= 10;
    }
    const auto above = static_cast<int>(std::lround(numerator)), below = static_cast<int>(std::lround(denominator));
    const int common = std::gcd(above, below);
    return {above / common, below / common};
}

}  // namespace

Metadata picture_metadata(const scene::Scene& scene, const film::Rect& window, const std::string& tracer,
                          const std::string& exr_format) {
    const scene::Sampling& sampling = scene.sampling;
    const film::Rect& w = window;
    Metadata metadata;
    metadata.set("strata:version", STRATA_VERSION);
    metadata.set(kSceneKey, scene::print_scene(scene));
    if (w != film::Rect{0, 0, scene.film.width, scene.film.height}) {
        metadata.set("strata:crop", fmt::format("{},{},{},{}", w.x0, w.y0, w.x1, w.y1));
    }
    metadata.set("strata:tracer", tracer);
    metadata.set("strata:format", exr_format);
    metadata.set("strata:simd_target", noise::simd_target());
    metadata.set("strata:estimator", scene::name_of(sampling.estimator));
    metadata.set("strata:samples", scene::samples_a_pixel(sampling));
    metadata.set("strata:filter", filter_text(sampling));
    metadata.set("strata:seed", sampling.seed);
    return metadata;
}

void set_passes(Metadata& metadata, const scene::Sampling& sampling, int passes) {
    if (passes <= 1) return;
    metadata.set("strata:passes", passes);
    metadata.set("strata:samples", std::int64_t{passes} * sampling.N * sampling.N);
}

std::optional<FrameRate> frame_rate(const scene::Scene& scene) {
    const bool is_animated = scene.shutter.frame != 0 || !scene.camera.keys.empty() || scene::motion(scene).any();
    if (!is_animated) return std::nullopt;
    return nearest_fraction(scene.shutter.fps.numerator(), scene.shutter.fps.denominator());
}

}  // namespace strata::image
