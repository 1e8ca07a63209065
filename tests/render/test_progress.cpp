#include <doctest/doctest.h>

#include <chrono>
#include <vector>

#include "src/render/render.h"
#include "tests/render/image_functions.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::parallel;
using namespace strata::render;
using namespace strata::render::testing;

TEST_CASE("progress grows, stays within the whole, and counts rays") {
    const auto image = Formula([](double u, double, double) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(1);
        while (std::chrono::steady_clock::now() < end) {
        }
        return glm::vec3(static_cast<float>(u));
    });
    for (const auto kind : {scene::EstimatorKind::stratified, scene::EstimatorKind::shared}) {
        std::vector<Progress> reports;
        RenderOptions options;
        options.on_progress = [&](const Progress& progress) { reports.push_back(progress); };
        const RenderResult result =
            render::render(image, Estimator({kind, 2, 4, 1, 1, {}}), Rect{0, 0, 300, 200}, options);
        REQUIRE(reports.size() >= 2);
        for (std::size_t i = 0; i < reports.size(); ++i) {
            REQUIRE(reports[i].fraction > 0);
            REQUIRE(reports[i].fraction <= 1);
            REQUIRE(reports[i].rays <= result.counters.rays);
            if (i > 0) {
                REQUIRE(reports[i].seconds - reports[i - 1].seconds >= 0.099);
                REQUIRE(reports[i].seconds <= result.seconds);
            }
        }
        CHECK(result.cpu_seconds > 0);
        CHECK(result.cpu_seconds < 64 * result.seconds);
    }
}
