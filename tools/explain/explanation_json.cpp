#include "src/scene/enum_names.h"
#include "tools/explain/explanation.h"
#include "tools/report/json.h"

namespace strata::tools::explain {

namespace {

using report::Json;
using report::number;

Json feature_json(const Feature& feature) {
    return {{"name", feature.name}, {"needed", feature.needed}, {"why", feature.why}};
}

Json octave_json(const OctavePlan& octave) {
    Json roles = Json::array();
    for (const OctaveRole& role : octave.roles)
        roles.push_back({{"from", role.from}, {"to", role.to}, {"role", role.role}});
    return {{"octave", octave.octave},
            {"amplitude", octave.amplitude},
            {"wavelength", octave.wavelength},
            {"pixel_wide_at", octave.pixel_wide_at},
            {"below_tolerance_from", number(octave.below_tolerance_from)},
            {"roles", std::move(roles)}};
}

Json pilot_json(const Prediction& prediction) {
    if (!prediction.pilot) return nullptr;
    const double share = static_cast<double>(prediction.pilot->rays) / static_cast<double>(prediction.costs.rays);
    return {{"rays", prediction.pilot->rays}, {"share", share}, {"cpu_seconds", prediction.pilot->cpu_seconds}};
}

Json recorded_json(const Explanation& explanation) {
    if (!explanation.recorded) return nullptr;
    const Recorded& recorded = *explanation.recorded;
    return {{"passes", recorded.passes}, {"threads", recorded.threads}, {"simd_target", recorded.simd_target}};
}

}  // namespace

std::string explanation_json(const Explanation& explanation) {
    const scene::Scene& scene = explanation.scene;
    const film::Rect& w = explanation.window;
    Json features = Json::array(), octaves = Json::array(), relief = Json::array(), costs = Json::object();
    for (const Feature& feature : explanation.plan.features) features.push_back(feature_json(feature));
    for (const OctavePlan& octave : explanation.plan.octaves) octaves.push_back(octave_json(octave));
    for (const ReliefRow& row : explanation.plan.relief) {
        const noise::Certificate& c = row.certificate;
        relief.push_back({{"name", row.name},
                          {"type", row.type},
                          {"of", row.of},
                          {"octaves", row.octaves},
                          {"low", c.low},
                          {"high", c.high},
                          {"slope", c.slope},
                          {"bend", c.bend}});
    }
    for (const NamedCost& cost : costs_of(explanation)) {
        costs[cost.name] = {{"predicted", number(cost.predicted)},
                            {"low", cost.between ? Json(cost.between->low) : Json(nullptr)},
                            {"high", cost.between ? Json(cost.between->high) : Json(nullptr)},
                            {"actual", number(cost.actual)},
                            {"ratio", number(cost.ratio())}};
    }
    const Json json = {{"scene", explanation.name},
                       {"version", STRATA_VERSION},
                       {"width", scene.film.width},
                       {"height", scene.film.height},
                       {"crop", {w.x0, w.y0, w.x1, w.y1}},
                       {"estimator", scene::name_of(scene.sampling.estimator)},
                       {"N", scene.sampling.N},
                       {"m", scene.sampling.m},
                       {"tracer", explanation.tracer},
                       {"simd_target", explanation.simd_target},
                       {"threads", explanation.prediction.threads},
                       {"features", std::move(features)},
                       {"octaves", std::move(octaves)},
                       {"relief", std::move(relief)},
                       {"pilot", pilot_json(explanation.prediction)},
                       {"recorded", recorded_json(explanation)},
                       {"costs", std::move(costs)}};
    return report::text_of(json);
}

}  // namespace strata::tools::explain
