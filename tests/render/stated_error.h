// How often what a render in passes states of its error holds, over many seeds.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "src/render/progressive.h"
#include "src/scene/enum_names.h"
#include "tests/render/image_functions.h"

namespace strata::render::testing {

// A picture by independent unbiased samples, far more than those that are judged by it, and the mean square of its own
// error as its passes' differences tell.
struct Reference {
    film::Film film;
    double squared_error = 0;
};

inline Reference make_reference(const integrate::ImageFunction& image, estimate::EstimatorSettings settings,
                                const film::Rect& window, int N, int passes) {
    settings.kind = scene::EstimatorKind::stratified;
    settings.N = N;
    settings.seed = 987'654'321;
    ProgressiveResult result = render_progressively(image, settings, window, {.passes = passes});
    return {std::move(result.render.film), result.error->rmse * result.error->rmse};
}

// The mean square of a picture's error. That of the reference is independent of it, and comes off.
inline double squared_error(const film::Film& film, const Reference& reference) {
    double sum = 0;
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        const glm::dvec3 error = glm::dvec3(film.pixels()[i]) - glm::dvec3(reference.film.pixels()[i]);
        sum += glm::dot(error, error);
    }
    return sum / (3 * static_cast<double>(film.pixels().size())) - reference.squared_error;
}

struct StatedError {
    int trials = 0, held = 0;
    double passes = 0;            // mean
    double actual = 0, told = 0;  // root mean squares of the error and of its estimate
    double worst = 0;             // the largest error / its bound
};

inline StatedError judge_statements(const integrate::ImageFunction& image, const estimate::EstimatorSettings& settings,
                                    const film::Rect& window, const PassGoal& goal, const Reference& reference,
                                    int trials) {
    StatedError judged;
    judged.trials = trials;
    for (int trial = 0; trial < trials; ++trial) {
        estimate::EstimatorSettings s = settings;
        s.seed = 5000 + static_cast<std::uint64_t>(trial);
        RenderOptions options;
        options.threads = 1;
        const ProgressiveResult result = render_progressively(image, s, window, goal, options);
        const double error = std::max(0.0, squared_error(result.render.film, reference));
        judged.held += std::sqrt(error) <= result.error->high;
        judged.worst = std::max(judged.worst, std::sqrt(error) / result.error->high);
        judged.passes += 1.0 * result.passes / trials;
        judged.actual += error / trials;
        judged.told += result.error->rmse * result.error->rmse / trials;
    }
    judged.actual = std::sqrt(judged.actual);
    judged.told = std::sqrt(judged.told);
    return judged;
}

inline void log_statements(const std::string& what, const estimate::EstimatorSettings& settings,
                           const StatedError& judged) {
    MESSAGE(what, ", ", scene::name_of(settings.kind), " N = ", settings.N, ": ", judged.passes, " passes, error ",
            judged.actual, ", told ", judged.told, "; the bound held in ", judged.held, " of ", judged.trials,
            ", at worst ", judged.worst, " of it");
}

inline constexpr scene::EstimatorKind kRandomised[] = {
    scene::EstimatorKind::jittered, scene::EstimatorKind::stratified, scene::EstimatorKind::random,
    scene::EstimatorKind::sobol,    scene::EstimatorKind::shared,     scene::EstimatorKind::shared_sobol};

// Bounds of 95 % over 100 runs: at exactly 95 %, one list of runs in 36 would hold fewer.
inline constexpr int kLeastHeld = 90;

// For every estimator that takes passes.
inline void check_statements(const std::string& what, const integrate::ImageFunction& image,
                             estimate::EstimatorSettings settings, const film::Rect& window, const PassGoal& goal,
                             const Reference& reference) {
    for (const scene::EstimatorKind kind : kRandomised) {
        settings.kind = kind;
        const StatedError judged = judge_statements(image, settings, window, goal, reference, 100);
        log_statements(what, settings, judged);
        CHECK(judged.held >= kLeastHeld);
        // Else the reference is not worth its name.
        CHECK(std::sqrt(reference.squared_error) < 0.15 * judged.actual);
    }
}

// A picture that each estimator errs on. 24x16 pixels.
inline constexpr film::Rect kSmallWindow{3, 5, 27, 21};

// Rings, an edge and a smooth slope, all at rest.
inline auto rings() {
    return Formula([](double u, double v, double) {
        const double wave = 0.5 + 0.5 * std::cos(0.05 * (u * u + v * v));
        return glm::vec3(wave, 3 * u + 7 * v > 150 ? 1.0 : 0.0, 0.01 * u);
    });
}

// Dark but for a few small lights, far brighter: most of the error is in few pixels.
inline auto lights() {
    return Formula([](double u, double v, double) {
        const double x = std::fmod(u, 9.0) - 4.3, y = std::fmod(v, 7.0) - 3.1;
        return x * x + y * y < 0.6 ? glm::vec3(6, 4, 2) : glm::vec3(0.05f);
    });
}

}  // namespace strata::render::testing
