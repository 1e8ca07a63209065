#include "tools/explain/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "shaders_cpu/scene_parts.h"
#include "src/estimate/estimator.h"
#include "src/filter/bspline_table.h"
#include "src/scene/camera_path.h"
#include "src/scene/enum_names.h"
#include "src/scene/needs.h"
#include "tools/explain/octaves.h"

namespace strata::tools::explain {

namespace {

class FeatureList {
  public:
    void add(std::string name, bool needed, std::string why) {
        features_.push_back({std::move(name), needed, std::move(why)});
    }
    // One sentence for each of two cases.
    void add(const char* name, bool needed, const char* why, const char* why_not) {
        features_.push_back({name, needed, needed ? why : why_not});
    }
    std::vector<Feature> take() { return std::move(features_); }

  private:
    std::vector<Feature> features_;
};

std::string time_reason(const scene::Scene& scene, const scene::Motion& motion) {
    if (scene.shutter.open_s <= 0.0) return "the shutter is open for an instant: shutter.open_s is 0";
    if (!motion.any()) {
        return fmt::format("the shutter is open for {} s, but nothing moves: all samples at its middle",
                           scene.shutter.open_s);
    }
    const scene::EstimatorRow& estimator = scene::row_of(scene.sampling.estimator);
    if (estimator.is_single) return fmt::format("the estimator {} samples mid-shutter alone", estimator.name);
    return fmt::format("the shutter is open for {} s and something moves; order {}", scene.shutter.open_s,
                       scene.sampling.time_order);
}

// Moving things cost something a sample only where the samples have times of their own.
const char* instant_note(const scene::Scene& scene) {
    return scene::needs_time_samples(scene) ? "worked out for each sample's time"
                                            : "worked out once: all samples share a time";
}

void add_motion(FeatureList& list, const scene::Scene& scene) {
    const scene::Motion motion = scene::motion(scene);
    list.add("time samples", scene::needs_time_samples(scene), time_reason(scene, motion));
    if (scene.image == scene::ImageKind::wheel) {
        list.add("turning wheel", motion.wheel, instant_note(scene), "wheel.turns_per_s is 0");
        return;
    }
    if (scene.image != scene::ImageKind::surface) return;
    const bool has_path = scene::CameraPath(scene.camera).moves();
    list.add("camera motion", motion.camera, instant_note(scene),
             has_path ? "the camera rests while the shutter is open" : "camera.keys has fewer than two keys");
    list.add("spin", motion.spin, instant_note(scene), "surface.spin_deg_per_s is 0");
    list.add("drift", motion.drift, "the noise is evaluated at shifted points",
             scene.surface.drift == glm::dvec3(0.0)
                 ? "surface.drift is 0"
                 : "this drift does not change the surface: no octaves, or a height field that drifts up or down");
    if (scene.clouds.empty()) return;
    list.add("drifting clouds", motion.clouds,
             "each sample sees the clouds, and their shadows, where they are at its time",
             "wind_m_s is 0 in all [[clouds]]");
}

const char* shadow_reason(const scene::Sun& sun) {
    if (!sun.shadows) return "sun.shadows is false";
    if (!(sun.intensity > 0.0)) return "sun.intensity is 0";
    if (sun.colour == glm::dvec3(0.0)) return "sun.colour is black";
    return "sun.shadows; from every hit that faces the sun";
}

void add_surface(FeatureList& list, const scene::Scene& scene) {
    const scene::Surface& surface = scene.surface;
    const trace::Field field(surface);
    const int octaves = static_cast<int>(field.octaves().size());
    const bool planar = field.is_planar_noise();
    const bool composed = field.relief() != nullptr, has_noise = composed || octaves > 0;
    list.add("relief", composed, "terms of [[relief]] stand for the sum of [surface]",
             "no [[relief]]: the sum of octaves of [surface]");
    list.add("2-D noise", planar && has_noise,
             !has_noise ? "surface.amplitude is 0"
             : planar   ? "a terrain is a height field over (x, z)"
                        : fmt::format("a surface of kind {} needs noise in space", scene::name_of(surface.kind)));
    list.add("3-D noise", !planar && has_noise,
             !has_noise ? "surface.amplitude is 0"
             : planar   ? "a terrain is a height field: its noise does not depend on y"
                        : fmt::format("a surface of kind {} has overhangs or is closed", scene::name_of(surface.kind)));
    if (!composed && octaves < surface.octaves) {
        list.add(
            "finest octaves", false,
            fmt::format("{} of {} are below the last bit of a double", surface.octaves - octaves, surface.octaves));
    }
    list.add("ball or box", solid::row_of(surface.kind).has_bound,
             "the isosurface is cut from a ball or box; hits on it need no noise for their normal",
             "only isosurfaces are cut from a ball or box");
    list.add("shadow rays", scene::needs_shadow_rays(scene), shadow_reason(scene.sun));
    list.add("soft sun", scene.sun.angular_radius_deg > 0.0,
             "shadow rays to a point of the sun's disc a sample, without beams from the sun",
             "sun.angular_radius_deg is 0: hard shadows");
    const bool sky_rays = scene::needs_sky_rays(scene);
    list.add("sky rays", sky_rays,
             sky_rays ? fmt::format("a ray a hit; what it meets is lit in its turn, sky.bounces = {} times at most",
                                    scene.sky.bounces)
                      : "sky.light is \"open\": the sky's light by a formula, as if all of it were seen");
    const bool shafts = scene::needs_fog_shafts(scene);
    list.add("shafts of sunlight", shafts,
             shafts ? "a place in the fog a sample, and a shadow ray from there"
                    : "fog.shafts is false, or there is no fog: hills throw no shadow into it");
    const bool water = scene::needs_water(scene);
    list.add("water", water,
             water ? fmt::format("level, at {} m: a mirrored and a refracted ray where a ray ends on it",
                                 scene.water.level_m)
                   : "water.present is false");
    for (shaders::ScenePart& part : shaders::scene_parts(scene)) {
        list.add(part.name, part.is_needed, std::move(part.why));
    }
}

std::vector<ReliefRow> relief_rows(const scene::Surface& surface) {
    const trace::Field field(surface);
    std::vector<ReliefRow> rows;
    for (std::size_t i = 0; field.relief() != nullptr && i < surface.relief.size(); ++i) {
        const noise::ReliefTerm& term = surface.relief[i];
        const std::string type = std::visit([](const auto& node) { return std::string(node.kType); }, term.node);
        rows.push_back({term.name, type, fmt::format("{}", fmt::join(term.of, ", ")),
                        field.relief()->parts()[i].octaves.size(), field.relief()->certificates()[i]});
    }
    return rows;
}

void add_estimator(FeatureList& list, const scene::Scene& scene) {
    const estimate::Estimator estimator(estimate::estimator_settings(scene));
    const scene::Sampling& sampling = scene.sampling;
    const std::string name(scene::name_of(sampling.estimator));
    const bool is_table = sampling.m <= filter::kMaxTableOrder;
    const bool inverts = estimator.inverts_filter();
    list.add("inverse table", inverts && is_table,
             !inverts ? fmt::format("{} does not place samples by the filter's inverse", name)
             : is_table
                 ? fmt::format("bulk inverse of the B-spline of order {}", sampling.m)
                 : fmt::format("the exact inverse instead: m = {} is above {}", sampling.m, filter::kMaxTableOrder));
    if (inverts && !is_table) list.add("exact inverse", true, "microseconds a coordinate");
    const bool times = scene::needs_time_samples(scene);
    const bool time_table = times && sampling.time_order <= filter::kMaxTableOrder;
    list.add("time table", time_table,
             time_table ? fmt::format("bulk inverse of the time filter of order {}", sampling.time_order)
             : times    ? fmt::format("the exact inverse instead: time_order = {} is above {}", sampling.time_order,
                                      filter::kMaxTableOrder)
                        : "no time samples");
    list.add("filter weights", estimator.weighs_samples(), "samples are weighted by the B-spline",
             "a pixel's samples have equal weights");
    list.add("shared samples", estimator.shared(), "each sample is added to the m x m pixels around it",
             "a sample belongs to one pixel: nothing is kept between pixels");
}

}  // namespace

Plan make_plan(const scene::Scene& scene, integrate::Tracer tracer, int passes, const integrate::ChannelSet& aovs) {
    FeatureList list;
    Plan plan;
    add_motion(list, scene);
    if (scene.image == scene::ImageKind::surface) {
        add_surface(list, scene);
        plan.relief = relief_rows(scene.surface);
        plan.octaves = plan_octaves(scene);
        plan.octaves_note = octaves_note(scene, tracer);
    } else {
        list.add("ray casting", false,
                 fmt::format("the picture is an image-plane pattern: {}", scene::name_of(scene.image)));
    }
    add_estimator(list, scene);
    list.add("more passes", passes > 1,
             passes > 1 ? fmt::format("{} passes are averaged; the costs below are those of one", passes)
                        : "one pass: nothing is summed up between passes");
    list.add("other channels", !aovs.empty(),
             aovs.empty() ? "pictures hold colour alone: no depth, normals or other AOVs"
                          : fmt::format("--aov: {}", fmt::join(job::aov_channels(aovs), ", ")));
    plan.features = list.take();
    return plan;
}

}  // namespace strata::tools::explain
