#include "tools/picture_metadata.h"

#include <fmt/format.h>

#include "noise/simd_target.h"
#include "src/scene/enum_names.h"
#include "src/scene/printer.h"

namespace strata::tools {

namespace {

std::string filter_text(const scene::Sampling& sampling) {
    if (sampling.estimator == scene::EstimatorKind::none) return "none";
    if (sampling.estimator == scene::EstimatorKind::super) return "box";
    return fmt::format("B-spline of order {}", sampling.m);
}

}  // namespace

image::Metadata picture_metadata(const scene::Scene& scene, const render::Window& window, const std::string& tracer,
                                 const std::string& exr_format) {
    const scene::Sampling& sampling = scene.sampling;
    const render::Window& w = window;
    image::Metadata metadata;
    metadata.set("strata:version", STRATA_VERSION);
    metadata.set(image::kSceneKey, scene::print_scene(scene));
    if (w != render::Window{0, 0, scene.film.width, scene.film.height}) {
        metadata.set("strata:crop", fmt::format("{},{},{},{}", w.x0, w.y0, w.x1, w.y1));
    }
    metadata.set("strata:tracer", tracer);
    metadata.set("strata:format", exr_format);
    metadata.set("strata:simd_target", noise::simd_target());
    metadata.set("strata:estimator", scene::name_of(sampling.estimator));
    metadata.set("strata:samples", sampling.estimator == scene::EstimatorKind::none ? 1 : sampling.N * sampling.N);
    metadata.set("strata:filter", filter_text(sampling));
    metadata.set("strata:seed", sampling.seed);
    return metadata;
}

void set_passes(image::Metadata& metadata, const scene::Sampling& sampling, int passes) {
    if (passes <= 1) return;
    metadata.set("strata:passes", passes);
    metadata.set("strata:samples", std::int64_t{passes} * sampling.N * sampling.N);
}

}  // namespace strata::tools
