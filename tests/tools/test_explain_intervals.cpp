// The counts of a render lie where `strata explain` says.
#include <doctest/doctest.h>

#include <string>

#include "tests/support/builtins.h"
#include "tests/tools/explained_counts.h"

using namespace strata::tools::explain;
using namespace strata::tools::explain::testing;
using namespace strata;

TEST_CASE("counts of every built-in scene lie within their intervals") {
    Verdicts verdicts;
    for (const scene::BuiltinScene& builtin : support::builtins_to_render()) {
        judge(builtin.name, builtin_of_size(builtin, 160, 1), verdicts);
    }
    conclude(verdicts);
}

TEST_CASE("counts lie within their intervals for every estimator") {
    Verdicts verdicts;
    for (const scene::EstimatorRow& row : scene::all_estimators()) {
        for (const char* name : {"terrain", "planet"}) {
            scene::Scene scene = builtin_of_size(*scene::find_builtin(name), 224, 3);
            scene.sampling.estimator = row.kind;
            judge(std::string(name) + " " + std::string(row.name), scene, verdicts);
        }
    }
    conclude(verdicts);
}

TEST_CASE("of scenes with sky rays every count is predicted, with an interval that holds it") {
    Verdicts verdicts;
    for (const char* name : {"terrain", "planet"}) {
        for (const int bounces : {0, 2}) {
            scene::Scene scene = builtin_of_size(*scene::find_builtin(name), 224, 2);
            scene.sky.light = scene::SkyLight::rays;
            scene.sky.bounces = bounces;
            judge(name, scene, verdicts);
        }
    }
    conclude(verdicts);
}

TEST_CASE("an interval is a point where all rays were cast and nothing is shared, and holds none where none hits") {
    scene::Scene scene = builtin_of_size(*scene::find_builtin("terrain"), 96, 2);
    Verdicts verdicts;
    judge("terrain", scene, verdicts);
    CHECK(verdicts.within == verdicts.counts);
    const film::Rect window{0, 0, 96, 54};
    constexpr Count kHits = &integrate::Counters::hits;
    const CountsBetween between = predict(scene, window, {.threads = 1}).between;
    CHECK(between[kHits]->low == between[kHits]->high);
    scene = builtin_of_size(*scene::find_builtin("terrain"), 640, 4);
    scene.camera.look_at = scene.camera.position + glm::dvec3(0.0, 1.0, 0.0);
    scene.camera.up = {0.0, 0.0, 1.0};
    const CountsBetween of_sky = predict(scene, {0, 0, 640, 360}, {.threads = 1}).between;
    CHECK(of_sky[kHits]->value == 0.0);
    // What no block shows may be there all the same.
    CHECK(of_sky[kHits]->high > 0.0);
    CHECK(of_sky[kHits]->high < 0.1 * 640 * 360 * 16);
}
