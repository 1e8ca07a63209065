#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>

#include "shaders_cpu/scene_parts.h"
#include "src/estimate/estimator.h"
#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "src/scene/builtin.h"
#include "src/scene/override.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tests/support/builtins.h"
#include "tests/support/estimators.h"
#include "tools/explain/explanation.h"
#include "tools/explain/pilot.h"

using namespace strata::tools::explain;
using namespace strata;

namespace {

scene::Scene small_builtin(const scene::BuiltinScene& builtin) {
    scene::Scene scene = scene::read_scene(builtin.text, builtin.name);
    scene.film.width = 128;
    scene.film.height = 72;
    scene.sampling.N = 2;
    return scene;
}

film::Rect whole(const scene::Scene& scene) { return {0, 0, scene.film.width, scene.film.height}; }

integrate::Counters count(const scene::Scene& scene, const film::Rect& window, integrate::Tracer tracer) {
    const auto image = integrate::make_image(scene, tracer);
    return render::render(*image, estimate::Estimator(estimate::estimator_settings(scene)), window).counters;
}

// The largest factor between predicted and actual counts, and its name.
struct Worst {
    double factor = 1.0;
    std::string name = "none";

    void compare(const char* count_name, const std::optional<double>& predicted, std::uint64_t actual) {
        REQUIRE(predicted.has_value());
        CHECK((*predicted == 0.0) == (actual == 0));
        if (actual == 0) return;
        const double ratio = *predicted / static_cast<double>(actual);
        const double off = std::max(ratio, 1.0 / ratio);
        if (off > factor) *this = {off, count_name};
    }
};

Worst worst_prediction(const scene::Scene& scene, const film::Rect& window, integrate::Tracer tracer) {
    const Prediction prediction =
        predict(scene, window, {.tracer = tracer, .threads = 1, .passes = 1, .with_pilot = true});
    const integrate::Counters actual = count(scene, window, tracer);
    CHECK(prediction.costs.rays == actual.rays);
    Worst worst;
    for (const auto& [name, counted] : integrate::kCounters) {
        if (is_predicted(counted)) worst.compare(name, prediction.costs.counts[counted], actual.*counted);
    }
    return worst;
}

const Feature& feature(const Plan& plan, const std::string& name) {
    const auto found = std::ranges::find(plan.features, name, &Feature::name);
    REQUIRE(found != plan.features.end());
    return *found;
}

Explanation explain(const scene::Scene& scene, bool with_pilot) {
    Explanation explanation;
    explanation.name = "scene";
    explanation.scene = scene;
    explanation.window = whole(scene);
    explanation.tracer = "fast";
    explanation.plan = make_plan(scene, integrate::Tracer::fast);
    explanation.prediction =
        predict(scene, explanation.window,
                {.tracer = integrate::Tracer::fast, .threads = 1, .passes = 1, .with_pilot = with_pilot});
    return explanation;
}

}  // namespace

TEST_CASE("counts are predicted within a factor of 1.5 on every built-in scene") {
    for (const scene::BuiltinScene& builtin : support::builtins_to_render()) {
        const scene::Scene scene = small_builtin(builtin);
        const Worst worst = worst_prediction(scene, whole(scene), integrate::Tracer::fast);
        MESSAGE(builtin.name << ": off by " << worst.factor << " at most (" << worst.name << "; allowed 1.5)");
        CHECK(worst.factor < 1.5);
    }
}

TEST_CASE("counts are predicted within a factor of 1.5 where many samples of a pixel share beams and windows") {
    scene::Scene scene = small_builtin(*scene::find_builtin("hyperterrain"));
    scene.film = {.width = 256, .height = 144};
    for (const int N : {1, 4, 10}) {
        scene.sampling.N = N;
        const Worst worst = worst_prediction(scene, whole(scene), integrate::Tracer::fast);
        MESSAGE("N = " << N << ": off by " << worst.factor << " (" << worst.name << ")");
        CHECK(worst.factor < 1.5);
    }
}

TEST_CASE("counts are predicted within a factor of 1.5 for every estimator, for a crop and for the reference tracer") {
    scene::Scene scene = small_builtin(*scene::find_builtin("terrain"));
    scene.surface.octaves = 6;
    for (const scene::EstimatorRow& row : scene::all_estimators()) {
        scene.sampling.estimator = row.kind;
        scene.sampling.m = 1 + static_cast<int>(row.kind);
        const Worst worst = worst_prediction(scene, whole(scene), integrate::Tracer::fast);
        MESSAGE(row.name << ": off by " << worst.factor << " (" << worst.name << ")");
        CHECK(worst.factor < 1.5);
    }
    scene.sampling.N = 5;
    CHECK(worst_prediction(scene, {10, 40, 70, 60}, integrate::Tracer::fast).factor < 1.5);
    scene.sampling = {.N = 2};
    scene.film = {.width = 64, .height = 36};
    CHECK(worst_prediction(scene, whole(scene), integrate::Tracer::reference).factor < 1.5);
}

TEST_CASE("a pilot takes a hundredth of the rays, no fewer than its least and no more than its most") {
    using integrate::Tracer;
    CHECK(pilot_rays(1, Tracer::fast) == 1);
    CHECK(pilot_rays(kLeastPilotRays, Tracer::fast) == kLeastPilotRays);
    CHECK(pilot_rays(2 * kLeastPilotRays, Tracer::fast) == 2 * kLeastPilotRays);
    CHECK(pilot_rays(2 * kMostReferenceRays, Tracer::reference) == kMostReferenceRays);
    CHECK(pilot_rays(10 * kLeastPilotRays, Tracer::fast) == kLeastPilotRays);
    CHECK(pilot_rays(10'000'000, Tracer::fast) == 100'000);
    CHECK(pilot_rays(std::uint64_t{1} << 44, Tracer::fast) == kMostPilotRays);
    CHECK(pilot_rays(std::uint64_t{1} << 44, Tracer::reference) == kMostReferenceRays);
    // The rays that are cast are not more.
    scene::Scene scene = small_builtin(*scene::find_builtin("zoneplate"));
    const auto image = integrate::make_image(scene);
    for (const int N : {1, 2, 3, 7, 64}) {
        for (const int side : {1, 2, 50, 300}) {
            scene.sampling.N = N;
            const estimate::EstimatorSettings settings = estimate::estimator_settings(scene);
            const std::uint64_t rays = std::uint64_t{1} * N * N * side * side;
            const std::uint64_t allowed = pilot_rays(rays, Tracer::fast);
            const PilotRun run = run_pilot(*image, settings, {0, 0, side, side}, allowed);
            CHECK(run.counters.rays <= allowed);
            CHECK(2 * run.counters.rays > allowed);
        }
    }
}

TEST_CASE("predicted counts are the same in every run") {
    const scene::Scene scene = small_builtin(*scene::find_builtin("isosurface"));
    const Costs a =
        predict(scene, whole(scene), {.tracer = integrate::Tracer::fast, .threads = 1, .passes = 1, .with_pilot = true})
            .costs;
    const Costs b =
        predict(scene, whole(scene), {.tracer = integrate::Tracer::fast, .threads = 8, .passes = 1, .with_pilot = true})
            .costs;
    for (const auto& [name, counted] : integrate::kCounters) CHECK(a.counts[counted] == b.counts[counted]);
}

TEST_CASE("without a pilot only what is certain is told") {
    scene::Scene scene = small_builtin(*scene::find_builtin("terrain"));
    scene.sampling.estimator = scene::EstimatorKind::stratified;
    const Costs costs = predict(scene, whole(scene),
                                {.tracer = integrate::Tracer::fast, .threads = 1, .passes = 1, .with_pilot = false})
                            .costs;
    CHECK(costs.rays == 128 * 72 * 4);
    CHECK(!costs.counts[&integrate::Counters::shadow_rays]);
    CHECK(!costs.counts[&integrate::Counters::noise_evaluations]);
    CHECK(!costs.seconds);
    CHECK(costs.peak_memory_bytes);
    scene.sun.shadows = false;
    CHECK(predict(scene, whole(scene),
                  {.tracer = integrate::Tracer::fast, .threads = 1, .passes = 1, .with_pilot = false})
              .costs.counts[&integrate::Counters::shadow_rays] == 0.0);
    scene.image = scene::ImageKind::checker;
    CHECK(predict(scene, whole(scene),
                  {.tracer = integrate::Tracer::fast, .threads = 1, .passes = 1, .with_pilot = false})
              .costs.counts[&integrate::Counters::noise_evaluations] == 0.0);
}

TEST_CASE("the plan names what is left out, and the counts agree") {
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 60; ++trial) {
        scene::Scene scene = small_builtin(*scene::find_builtin("terrain"));
        const auto coin = [&] { return random() % 2 == 0; };
        scene.film = {.width = 16, .height = 9};
        scene.camera.far = 20.0;
        scene.surface.kind = coin() ? solid::kKind<solid::HeightField> : solid::kKind<solid::DisplacedPlane>;
        scene.surface.octaves = 3;
        scene.sun.shadows = coin();
        if (coin()) scene.sun.colour = glm::dvec3(0.0);
        if (coin()) scene.surface.drift.x = 1.0;
        if (coin()) scene.shutter.open_s = 0.1;
        if (coin()) scene.sampling.m = 40;
        if (coin()) scene.surface.amplitude = 0.0;
        scene.sampling.estimator = support::any_estimator(random());
        const Plan plan = make_plan(scene, integrate::Tracer::fast);
        const integrate::Counters counters = count(scene, whole(scene), integrate::Tracer::fast);
        const estimate::Estimator estimator(estimate::estimator_settings(scene));
        CHECK(feature(plan, "shadow rays").needed == (counters.shadow_rays > 0));
        CHECK((feature(plan, "2-D noise").needed || feature(plan, "3-D noise").needed) ==
              (counters.noise_evaluations > 0));
        CHECK(feature(plan, "3-D noise").needed ==
              (scene.surface.kind == solid::kKind<solid::DisplacedPlane> && scene.surface.amplitude > 0.0));
        CHECK(feature(plan, "time samples").needed == !estimator.settings().shutter.instant());
        CHECK(feature(plan, "shared samples").needed == estimator.shared());
        for (const Feature& each : plan.features) CHECK(!each.why.empty());
    }
}

TEST_CASE("every light, background, medium and material has a row, needed where the picture has it") {
    std::set<std::string> needed_somewhere, left_out_somewhere;
    for (const char* keys : {"", "sky.model=daylight", "sky.light=rays", "sun.intensity=0", "fog.visibility_m=300",
                             "sky.haze_distance=50"}) {
        scene::Scene scene = small_builtin(*scene::find_builtin("planet"));
        scene.scale.metres = 300.0;
        if (*keys != '\0') scene::apply_override(scene, keys);
        const Plan plan = make_plan(scene, integrate::Tracer::fast);
        std::set<std::string> names;
        for (const Feature& each : plan.features) CHECK(names.insert(each.name).second);
        for (const shaders::ScenePart& part : shaders::scene_parts(scene)) {
            CHECK(feature(plan, part.name).needed == part.is_needed);
            (part.is_needed ? needed_somewhere : left_out_somewhere).insert(part.name);
        }
    }
    for (const char* name : {"sun", "sky light", "daylight sun", "fog", "haze", "daylight air"}) {
        CHECK(needed_somewhere.contains(name));
        CHECK(left_out_somewhere.contains(name));
    }
}

TEST_CASE("octaves halve as the scene says, and those that do nothing are told so") {
    scene::Scene scene = small_builtin(*scene::find_builtin("terrain"));
    scene.surface.gain = 0.25;
    scene.surface.scale = 3.0;
    scene.surface.octaves = 32;
    scene.surface.lacunarity = 1.0;
    const std::vector<OctavePlan> octaves = make_plan(scene, integrate::Tracer::fast).octaves;
    const trace::Field field(scene.surface);
    REQUIRE(octaves.size() == 32);
    std::size_t live = 0;
    for (std::size_t k = 0; k < octaves.size(); ++k) {
        const OctavePlan& octave = octaves[k];
        CHECK(octave.wavelength == doctest::Approx(3.0 / 0.2));
        CHECK(octave.amplitude == doctest::Approx(1.5 * std::pow(0.25, k)));
        REQUIRE(octave.roles.size() == 1);
        CHECK(octave.roles.front().to == scene.camera.far);
        live += octave.roles.front().role == "geometry";
        CHECK((octave.roles.front().role == "nothing") == (k >= field.octaves().size()));
    }
    CHECK(live == field.octaves().size());
    CHECK(live == 32);  // 4^-31 = 2^-62 still counts
    scene.surface.gain = 0.1;
    CHECK(make_plan(scene, integrate::Tracer::fast).octaves.back().roles.front().role == "nothing");
    // A pixel at the frame's centre spans 2 tan(fov/2) / width.
    const double angle = 2.0 * std::tan(0.5 * scene.camera.fov_deg * 3.14159265358979 / 180.0) / scene.film.width;
    CHECK(octaves.front().pixel_wide_at == doctest::Approx(15.0 / angle).epsilon(0.01));
}

TEST_CASE("the JSON holds what its help promises") {
    for (const char* name : {"terrain", "wheel"}) {
        scene::Scene scene = small_builtin(*scene::find_builtin(name));
        scene.sampling.estimator = scene::EstimatorKind::stratified;
        const Explanation explanation = explain(scene, true);
        const auto json = nlohmann::json::parse(explanation_json(explanation));
        for (const char* key : {"scene", "version", "width", "height", "crop", "estimator", "N", "m", "tracer",
                                "simd_target", "threads", "features", "octaves", "pilot", "recorded", "costs"}) {
            CHECK(json.contains(key));
        }
        CHECK(json["octaves"].size() == (std::string(name) == "terrain" ? 12 : 0));
        CHECK(json["recorded"].is_null());
        CHECK(json["costs"].size() == std::size(integrate::kCounters) + 2);
        CHECK(json["costs"]["rays"]["predicted"] == 128 * 72 * 4);
        CHECK(json["costs"]["rays"]["actual"].is_null());
        CHECK(json["pilot"]["rays"] == 128 * 72 * 4);
        for (const auto& each : json["features"]) CHECK(each["needed"].is_boolean());
        CHECK(explanation_text(explanation).find("left out") != std::string::npos);
    }
    const Explanation blind = explain(small_builtin(*scene::find_builtin("terrain")), false);
    const auto json = nlohmann::json::parse(explanation_json(blind));
    CHECK(json["pilot"].is_null());
    CHECK(json["costs"]["noise_evaluations"]["predicted"].is_null());
}
