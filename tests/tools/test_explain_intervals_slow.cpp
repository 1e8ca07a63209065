// The counts of a render lie where `strata explain` says: larger pictures, more samples, other cameras.
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "tests/tools/explained_counts.h"

using namespace strata;
using namespace strata::tools::explain;
using namespace strata::tools::explain::testing;

TEST_CASE("counts of every built-in scene lie within their intervals, at larger sizes and N") {
    Verdicts verdicts;
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        for (const auto& [width, N] : {std::pair(320, 10), {640, 4}, {1280, 2}}) {
            judge(builtin.name, builtin_of_size(builtin, width, N), verdicts);
        }
    }
    conclude(verdicts);
}

TEST_CASE("counts lie within their intervals wherever the camera looks") {
    Verdicts verdicts;
    for (const char* name : {"terrain", "planet", "hyperterrain", "isosurface"}) {
        for (int turn = 0; turn < 8; ++turn) {
            scene::Scene scene = builtin_of_size(*scene::find_builtin(name), 400, 3);
            scene.camera.keys.clear();
            scene.camera.fov_deg = 20.0 + 12.0 * turn;
            scene.camera.position.x += 0.37 * turn;
            judge(std::string(name) + " turn " + std::to_string(turn), scene, verdicts);
        }
    }
    conclude(verdicts);
}
