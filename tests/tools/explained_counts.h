// Whether a render's counts lie where `strata explain` says.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "src/estimate/estimator.h"
#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "tools/explain/prediction.h"

namespace strata::tools::explain::testing {

// Counts of one render within their intervals.
struct Verdicts {
    int counts = 0, within = 0;
    double widest = 0.0;  // half of an interval over its count

    void judge(const std::string& what, const std::string& name, const std::optional<CountEstimate>& between,
               std::uint64_t count) {
        REQUIRE(between.has_value());
        const auto actual = static_cast<double>(count);
        const bool holds = between->low <= actual && actual <= between->high;
        ++counts;
        within += holds;
        const double half = actual > 0.0 ? 0.5 * (between->high - between->low) / actual : 0.0;
        widest = std::max(widest, half);
        MESSAGE(what, " ", name, ": ", between->value / std::max(actual, 1.0), ", within ", half,
                std::string(holds ? "" : " - NOT within"));
    }
};

inline void judge(const std::string& name, const scene::Scene& scene, Verdicts& verdicts) {
    const film::Rect window{0, 0, scene.film.width, scene.film.height};
    const CountsBetween between =
        predict(scene, window, {.tracer = integrate::Tracer::fast, .threads = 1, .passes = 1, .with_pilot = true})
            .between;
    const auto image = integrate::make_image(scene);
    const integrate::Counters actual =
        render::render(*image, estimate::Estimator(estimate::estimator_settings(scene)), window).counters;
    const std::string what = name + ' ' + std::to_string(scene.film.width) + " N = " + std::to_string(scene.sampling.N);
    for (const auto& [counted, count] : integrate::kCounters) {
        if (is_predicted(count)) verdicts.judge(what, counted, between[count], actual.*count);
    }
}

inline scene::Scene builtin_of_size(const scene::BuiltinScene& builtin, int width, int N) {
    scene::Scene scene = scene::read_scene(builtin.text, builtin.name);
    scene.film.width = width;
    scene.film.height = width * 9 / 16;
    scene.sampling.N = N;
    return scene;
}

// Of intervals that hold 99 times in 100: as many misses as that brings, and two standard deviations more.
inline void conclude(const Verdicts& verdicts) {
    const double expected = 0.01 * verdicts.counts;
    MESSAGE(verdicts.within, " of ", verdicts.counts, " within; the widest interval is +-", verdicts.widest);
    CHECK(verdicts.counts - verdicts.within <= expected + 2.0 * std::sqrt(expected));
}

}  // namespace strata::tools::explain::testing
