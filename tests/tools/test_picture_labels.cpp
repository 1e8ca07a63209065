#include "tools/job/picture_labels.h"

#include <doctest/doctest.h>

#include "tools/job/batch_progress.h"

using namespace strata::tools::job;
using namespace strata;

namespace {

using Labels = std::vector<std::string>;

scene::Scene with(int N, int m, scene::EstimatorKind estimator = scene::EstimatorKind::stratified) {
    scene::Scene scene;
    scene.sampling.N = N;
    scene.sampling.m = m;
    scene.sampling.estimator = estimator;
    return scene;
}

}  // namespace

TEST_CASE("labels tell what differs and nothing else") {
    CHECK(labels_of({with(2, 4), with(10, 4)}, {"a", "b"}) == Labels{"N = 2", "N = 10"});
    CHECK(labels_of({with(2, 1), with(10, 4)}, {"a", "b"}) == Labels{"N = 2, m = 1", "N = 10, m = 4"});
    CHECK(labels_of({with(3, 4, scene::EstimatorKind::none), with(2, 4), with(10, 4)}, {"a", "b", "c"}) ==
          Labels{"no antialiasing", "N = 2", "N = 10"});
    CHECK(labels_of({with(2, 4), with(2, 4, scene::EstimatorKind::sobol)}, {"a", "b"}) ==
          Labels{"stratified", "sobol"});
    scene::Scene fewer = with(2, 4);
    fewer.surface.octaves = 3;
    CHECK(labels_of({with(2, 4), fewer}, {"a", "b"}) == Labels{"octaves = 8", "octaves = 3"});
    scene::Scene curved = with(2, 4);
    curved.film.tone = scene::ToneCurve::agx;
    CHECK(labels_of({with(2, 4), curved}, {"a", "b"}) == Labels{"tone = none", "tone = agx"});
}

TEST_CASE("pictures that cannot be told apart by their scenes go by their names") {
    CHECK(labels_of({with(2, 4), with(2, 4)}, {"a", "b"}) == Labels{"a", "b"});
    CHECK(labels_of({with(2, 4), std::nullopt}, {"a", "photo"}) == Labels{"stratified, N = 2, m = 4", "photo"});
    CHECK(labels_of({}, {}) == Labels{});
}

TEST_CASE("several renders progress as one, by their weights, and never backwards") {
    std::vector<parallel::Progress> shown;
    BatchProgress batch(40, [&](const parallel::Progress& p) { shown.push_back(p); });
    for (const double weight : {10.0, 30.0}) {
        const auto callback = batch.next(weight);
        for (const double fraction : {0.0, 0.5, 1.0})
            callback({.fraction = fraction, .rays = static_cast<std::uint64_t>(100 * fraction), .seconds = 1});
    }
    const double fractions[] = {0, 0.125, 0.25, 0.25, 0.625, 1};
    const std::uint64_t rays[] = {0, 50, 100, 100, 150, 200};
    REQUIRE(shown.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(shown[i].fraction == doctest::Approx(fractions[i]));
        CHECK(shown[i].rays == rays[i]);
        CHECK(shown[i].seconds >= (i == 0 ? 0 : shown[i - 1].seconds));
    }
}
