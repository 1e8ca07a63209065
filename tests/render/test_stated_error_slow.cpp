// What a render in passes says of its error, of more samples, other images and scenes with a surface.
#include <doctest/doctest.h>

#include "src/integrate/make_image.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "tests/render/stated_error.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::render;
using namespace strata::render::testing;
using scene::EstimatorKind;

TEST_CASE("pictures of formulas that stopped at a target, or after some passes, are as good as stated") {
    EstimatorSettings settings{EstimatorKind::stratified, 1, 4, 1, 1, {}};
    const Reference of_rings = make_reference(rings(), settings, kSmallWindow, 32, 64);
    const Reference of_lights = make_reference(lights(), settings, kSmallWindow, 32, 64);
    for (const int N : {1, 3}) {
        settings.N = N;
        check_statements("rings", rings(), settings, kSmallWindow, {.passes = kMostPasses, .target_rmse = 0.01},
                         of_rings);
        check_statements("lights", lights(), settings, kSmallWindow, {.passes = kMostPasses, .target_rmse = 0.04},
                         of_lights);
        for (const int passes : {5, 16, 64}) {
            check_statements("rings", rings(), settings, kSmallWindow, {.passes = passes}, of_rings);
            check_statements("lights", lights(), settings, kSmallWindow, {.passes = passes}, of_lights);
        }
    }
}

TEST_CASE("pictures of surfaces that stopped at a target are as good as stated") {
    for (const char* name : {"terrain", "planet"}) {
        scene::Scene scene = scene::read_scene(scene::find_builtin(name)->text, name);
        scene.film.width = 24;
        scene.film.height = 16;
        const auto image = make_image(scene);
        const Rect window{0, 0, 24, 16};
        EstimatorSettings settings = estimator_settings(scene);
        const Reference reference = make_reference(*image, settings, window, 32, 32);
        for (const int N : {1, 2}) {
            settings.N = N;
            check_statements(name, *image, settings, window, {.passes = kMostPasses, .target_rmse = 0.012}, reference);
        }
    }
}
