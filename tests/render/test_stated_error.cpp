// What a render in passes says of its error holds: for the error of that very picture, bias included.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/render/stated_error.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::render;
using namespace strata::render::testing;
using scene::EstimatorKind;

TEST_CASE("a picture that stopped at a target is as good as stated, for every estimator") {
    const EstimatorSettings settings{EstimatorKind::stratified, 2, 4, 1, 1, {}};
    const Reference of_rings = make_reference(rings(), settings, kSmallWindow, 32, 32);
    const Reference of_lights = make_reference(lights(), settings, kSmallWindow, 32, 32);
    check_statements("rings", rings(), settings, kSmallWindow, {.passes = kMostPasses, .target_rmse = 0.02}, of_rings);
    check_statements("lights", lights(), settings, kSmallWindow, {.passes = kMostPasses, .target_rmse = 0.05},
                     of_lights);
}

TEST_CASE("so is one that a number of passes ended, which a time limit or an interruption may choose") {
    const EstimatorSettings settings{EstimatorKind::stratified, 1, 4, 1, 1, {}};
    const Reference reference = make_reference(rings(), settings, kSmallWindow, 32, 32);
    for (const int passes : {4, 21}) {
        check_statements("rings", rings(), settings, kSmallWindow, {.passes = passes}, reference);
    }
}

TEST_CASE("the bias of a ratio falls with the number of passes, and what is told of it covers it") {
    // Of a mean of pixels it would stay.
    for (const EstimatorKind kind : {EstimatorKind::shared, EstimatorKind::shared_sobol, EstimatorKind::jittered}) {
        EstimatorSettings settings{kind, 2, 4, 1, 7, {}};
        const auto image = rings();
        const Reference reference = make_reference(image, settings, kSmallWindow, 32, 64);
        const ProgressiveResult few = render_progressively(image, settings, kSmallWindow, {.passes = 16});
        const ProgressiveResult many = render_progressively(image, settings, kSmallWindow, {.passes = 4096});
        const double error = std::sqrt(std::max(0.0, squared_error(many.render.film, reference)));
        MESSAGE(scene::name_of(kind), ": error ", error, ", told below ", many.error->high, "; bias told ",
                few.error->bias, " of 16 passes, ", many.error->bias, " of 4096");
        CHECK(error <= many.error->high);
        CHECK(many.error->high < 0.003);
        CHECK(many.error->bias < few.error->bias / 50);
    }
}
