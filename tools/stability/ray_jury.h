// Traces rays of a scene and has an oracle that shares no code with the tracers judge each by the two promises of
// src/README.md: nothing thicker than delta is passed over, and within delta of a reported hit there is a point with f
// <= 0.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/integrate/surface_image.h"
#include "tools/stability/case.h"
#include "tools/stability/scene_spec.h"

namespace strata::tools::stability {

struct WorldRay {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0};
    std::optional<glm::ivec2> pixel;  // the camera's ray through its centre; else origin and direction count
};

class RayJury {
  public:
    // Rays are given up after step_limit steps.
    RayJury(const SceneSpec& spec, const Settings& settings, std::uint32_t step_limit = trace::kStepLimit);

    const scene::Scene& scene() const { return scene_; }
    const integrate::SurfaceImage& image() const { return image_; }
    const trace::Field& field() const { return image_.field(); }

    // Mid-shutter, when all rays are traced.
    double time() const;

    // In the surface's coordinates.
    trace::Ray local(const WorldRay& ray) const;
    std::vector<trace::Hit> trace(std::span<const trace::Ray> rays) const;

    // Traces and judges.
    void judge(std::span<const WorldRay> rays);

    // Judges what was found along `ray`. displaced: how far off its points may be, in surface units. describe says how
    // to replay it.
    void judge_claim(const trace::Ray& ray, const trace::Hit& hit, double displaced,
                     const std::function<std::string()>& describe);

    // Judged so far; of these hits, given up, and against a promise; the last such.
    long judged() const { return rays_; }
    long hits() const { return hits_; }
    long unresolved() const { return unresolved_; }
    long violations() const { return violations_; }
    long judged_in_part() const { return cut_short_; }
    const std::string& violation() const { return violation_; }

    // A bound of what rounding leaves open of f up to `size` from the surface's origin.
    double rounding(double size) const;

    // A check that no ray broke a promise or was left unresolved, and the statistics of steps.
    std::vector<Row> rows(const std::string& name) const;

    // How a ray is replayed on the command line.
    std::string replay(const WorldRay& ray) const;

  private:
    SceneSpec spec_;
    scene::Scene scene_;
    Settings settings_;
    integrate::SurfaceImage image_;
    long rays_ = 0, hits_ = 0, unresolved_ = 0, violations_ = 0, undecided_ = 0, cut_short_ = 0;
    double thickest_ = 0.0, steps_ = 0.0;
    Worst most_steps_;
    std::string violation_;
};

}  // namespace strata::tools::stability
