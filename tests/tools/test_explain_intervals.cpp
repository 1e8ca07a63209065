// The counts of a render lie where `strata explain` says.
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "tests/tools/explained_counts.h"

using namespace strata::tools::explain;
using namespace strata::tools::explain::testing;
using namespace strata;

TEST_CASE("counts of every built-in scene lie within their intervals, at several sizes and N") {
    Verdicts verdicts;
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        for (const auto& [width, N] : {std::pair(160, 1), {160, 4}, {320, 2}, {480, 1}}) {
            judge(builtin.name, builtin_of_size(builtin, width, N), verdicts);
        }
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

TEST_CASE("an interval is a point where all rays were cast and nothing is shared, and holds none where none hits") {
    scene::Scene scene = builtin_of_size(*scene::find_builtin("terrain"), 96, 2);
    Verdicts verdicts;
    judge("terrain", scene, verdicts);
    CHECK(verdicts.within == verdicts.counts);
    const film::Rect window{0, 0, 96, 54};
    const CountsBetween between = predict(scene, window, {.threads = 1}).between;
    CHECK(between.hits->low == between.hits->high);
    scene = builtin_of_size(*scene::find_builtin("terrain"), 640, 4);
    scene.camera.look_at = scene.camera.position + glm::dvec3(0.0, 1.0, 0.0);
    scene.camera.up = {0.0, 0.0, 1.0};
    const CountsBetween of_sky = predict(scene, {0, 0, 640, 360}, {.threads = 1}).between;
    CHECK(of_sky.hits->value == 0.0);
    // What no block shows may be there all the same.
    CHECK(of_sky.hits->high > 0.0);
    CHECK(of_sky.hits->high < 0.1 * 640 * 360 * 16);
}
