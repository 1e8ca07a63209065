#include <doctest/doctest.h>

#include <cmath>

#include "tools/cli/errors.h"
#include "tools/job/aov.h"
#include "tools/job/cost_picture.h"

using namespace strata::tools::cli;
using namespace strata::tools::job;
using namespace strata;

namespace {

// Strips of a picture whose costs are (x, 2 y).
void add_strips(CostPicture& picture, const film::Rect& window, int rows) {
    for (int y0 = window.y0; y0 < window.y1; y0 += rows) {
        film::Film strip({window.x0, y0, window.x1, std::min(y0 + rows, window.y1)}, {.channel_values = 2});
        for (int y = y0; y < strip.window().y1; ++y) {
            for (int x = window.x0; x < window.x1; ++x) {
                strip.channels_at(x, y)[0] = static_cast<float>(x);
                strip.channels_at(x, y)[1] = 2.0f * static_cast<float>(y);
            }
        }
        picture.add(strip);
    }
}

integrate::ChannelSet parse(const std::string& text) { return parse_aovs(text, {}); }

integrate::ChannelSet::Entry steps() { return parse("steps,evals").entries()[0]; }
integrate::ChannelSet::Entry evals() { return parse("steps,evals").entries()[1]; }

}  // namespace

TEST_CASE("names of AOVs are taken in any order, make each channel once, and no other word is taken") {
    CHECK(names_of(parse("steps")) == "steps");
    CHECK(names_of(parse("evals,steps,evals")) == "evals,steps");
    estimate::EstimatorSettings estimator;
    estimator.kind = scene::EstimatorKind::random;
    CHECK(names_of(parse_aovs("all", estimator, {"rock"})) == all_aov_names());
    CHECK(names_of(parse_aovs("all", estimator)).find("mask") == std::string::npos);
    CHECK_THROWS_AS(parse_aovs("cryptomatte", estimator), UsageError);
    estimator.kind = scene::EstimatorKind::sobol;
    CHECK(names_of(parse_aovs("all", estimator)).find("variance") == std::string::npos);
    CHECK_THROWS_AS(parse_aovs("variance", estimator), UsageError);
    CHECK(aov_channels(parse("steps,evals")) == std::vector<std::string>{"steps.Y", "evals.Y"});
    for (const char* text : {"", "step", "steps,", ",evals", "steps evals", "steps,all"}) {
        CHECK_THROWS_AS(parse(text), UsageError);
    }
}

TEST_CASE("the cost picture of a large window is small, and the same whatever strips it came in") {
    const film::Rect window{3, 5, 3 + 2 * kLongestCostSide + 1, 5 + 40};
    image::Canvas first;
    for (const int rows : {64, 16, 7}) {
        CostPicture picture(steps(), window);
        add_strips(picture, window, rows);
        const image::Canvas canvas = picture.draw("wide");
        CHECK(canvas.width < kLongestCostSide + 100);
        if (first.rgb.empty()) first = canvas;
        CHECK(canvas.rgb == first.rgb);
    }
    CostPicture other(evals(), window);
    add_strips(other, window, 64);
    CHECK(other.draw("wide").rgb != first.rgb);
}

TEST_CASE("false colour grows brighter with the cost, from black to the scale's top") {
    const film::Rect window{0, 0, 101, 8};
    CostPicture picture(steps(), window);
    add_strips(picture, window, 64);
    const image::Canvas canvas = picture.draw("");
    // The picture's first row: found by its black left end and pale right end.
    int rows = 0;
    for (int y = 0; y < canvas.height; ++y) {
        for (int x0 = 0; x0 + 101 <= canvas.width; ++x0) {
            const auto luminance = [&](int x) {
                const float* rgb = &canvas.rgb[3 * static_cast<std::size_t>(y * canvas.width + x0 + x)];
                return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
            };
            bool grows = luminance(0) < 0.01f && luminance(100) > 0.9f && luminance(25) > 0.2f;
            for (int x = 1; x < 101 && grows; ++x) grows = luminance(x) >= luminance(x - 1) - 0.004f;
            rows += grows ? 1 : 0;
        }
    }
    CHECK(rows >= 8);
}
