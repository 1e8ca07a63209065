#include <doctest/doctest.h>

#include <chrono>
#include <vector>

#include "src/render/progress_printer.h"
#include "src/render/render.h"
#include "src/render/status_line.h"
#include "tests/render/image_functions.h"

using namespace strata;
using namespace strata::render;
using namespace strata::render::testing;

TEST_CASE("durations and the progress line read well") {
    CHECK(duration_text(-1) == "0 s");
    CHECK(duration_text(0.2) == "1 s");
    CHECK(duration_text(59.5) == "1 min 00 s");
    CHECK(duration_text(65) == "1 min 05 s");
    CHECK(duration_text(7380) == "2 h 03 min");
    CHECK(progress_line({0.42, 3100000, 1.0}) == " 42 %, 3.1 M rays/s, 2 s left");
    CHECK(progress_line({0.0, 0, 0.0}) == "  0 %, 0 M rays/s");
}

TEST_CASE("a render is called long only on a sufficient basis") {
    CHECK(!predicted_long({0.0001, 1, 1.0}));
    CHECK(predicted_long({0.0001, 1, 2.0}));
    CHECK(predicted_long({0.0049, 1, 3.0}));
    CHECK(!predicted_long({0.0051, 1, 3.0}));
    CHECK(!predicted_long({0.0, 0, 1000.0}));
}

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
            render::render(image, Estimator({kind, 2, 4, 1, 1, {}}), Window{0, 0, 300, 200}, options);
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

TEST_CASE("a status line is cut to the terminal's width, its characters whole") {
    CHECK(cut_to_columns("12345", 5) == "12345");
    CHECK(cut_to_columns("12345", 4) == "1234");
    CHECK(cut_to_columns("Größe", 4) == "Größ");
    CHECK(cut_to_columns("山山", 1) == "山");
    CHECK(cut_to_columns("abc", 0).empty());
    CHECK(cut_to_columns("", 3).empty());
}
