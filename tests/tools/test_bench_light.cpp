// What `strata bench` compares to tell the cost of a still's light.
#include <doctest/doctest.h>

#include <string>

#include "src/estimate/estimator.h"
#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "tools/bench/light_features.h"
#include "tools/bench/plan.h"
#include "tools/bench/report.h"

using namespace strata::tools::bench;
using namespace strata;

namespace {

integrate::Counters counted(scene::Scene scene) {
    scene.film.width = 64;
    scene.film.height = 36;
    scene.sampling.N = 1;
    const auto image = integrate::make_image(scene);
    return render::render(*image, estimate::Estimator(estimate::estimator_settings(scene)), {0, 0, 64, 36}).counters;
}

}  // namespace

TEST_CASE("a part of a still's light casts the rays that it is named for, and the scene without it does not") {
    for (const LightFeature& feature : light_features()) {
        CAPTURE(feature.name);
        const integrate::Counters off = counted(feature.off.scene), on = counted(feature.on.scene);
        const std::string& name = feature.name;
        const auto is = [&](const char* word) { return name.find(word) != std::string::npos; };
        CHECK((on.sky_rays > off.sky_rays) == (is("sky rays") || is("bounce")));
        CHECK((on.water_rays > off.water_rays) == is("water"));
        CHECK((off.shadow_rays == 0) == (is("daylight") || is("of a point") || is("sun, sky and")));
        if (is("afar")) CHECK(on.shadow_rays < off.shadow_rays);
        if (is("shafts")) CHECK(on.shadow_rays > off.shadow_rays);
        if (is("clouds") || is("ground")) CHECK(on.noise_evaluations == off.noise_evaluations);
    }
}

TEST_CASE("what a part of the light costs is told as what it adds to a sample") {
    Results results{.plan = make_plan({.sections = {Section::light}, .quick = true, .whole = false, .rays = {}})};
    results.rounds = 1;
    for (const Case& what : results.plan.cases) {
        Measurement m{.what = what, .cpu_s = {1e-3}};
        m.counters.rays = 1000;
        results.measurements.push_back(m);
    }
    const FeaturePair& sky = results.plan.light[3];
    CHECK(sky.name == "sky rays");
    for (Measurement& m : results.measurements) {
        if (m.what.id() != sky.on) continue;
        m.cpu_s = {2.5e-3};
        m.counters.sky_rays = 750;
        m.counters.noise_evaluations = 6000;
    }
    const std::string text = text_report(results, {}, {});
    const std::size_t row = text.find("\nsky rays");
    REQUIRE(row != std::string::npos);
    const std::string line = text.substr(row + 1, text.find('\n', row + 1) - row - 1);
    for (const char* told : {"+0.75", "6", "1000", "2500", "2.50"}) CHECK_MESSAGE(line.find(told) != line.npos, line);
    CHECK(json_report(results, {}, {}).find("\"rays_per_sample_on\": 1.75") != std::string::npos);
}
