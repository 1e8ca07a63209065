// Error and time of estimators: the renders, and what is kept of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/image/picture.h"
#include "src/integrate/surface_image.h"
#include "src/parallel/cancel.h"
#include "src/scene/scene.h"
#include "tools/cli/progress_printer.h"
#include "tools/converge/statistics.h"

namespace strata::tools::converge {

// What is to be measured.
struct Settings {
    std::vector<scene::EstimatorKind> estimators;
    std::vector<int> orders;
    std::vector<int> Ns;  // ascending
    std::vector<integrate::Tracer> tracers;
    int seeds = 0;        // 0: as many as suit the image
    int repeats = 3;      // timed renders of a point, at least
    int threads = 0;      // of every render; 0: one for what is timed, all of the machine for the rest
    double budget_s = 0;  // 0: none
};

enum class Limit { none, reference, rounding };

// The picture that one order's renders should arrive at.
struct Reference {
    int m = 0;
    image::Picture picture;       // as floats, for the comparison
    std::vector<double> grey;     // mean of the channels, one a pixel
    double error = 0;             // RMSE of an engine reference; bound of an exact one
    double root_mean_square = 0;  // of its values
    bool exact = false;
    std::string how;
};

// Renders of one estimator, order, tracer and N.
struct Point {
    scene::EstimatorKind estimator{};
    int m = 0;
    integrate::Tracer tracer{};
    int N = 0;
    bool fixed = false;  // every seed gives the same picture

    integrate::Counters counters;  // of one render
    std::vector<double> seconds, cpu_seconds;
    std::vector<double> mean_squares, relative, largest, percentile99;  // one a seed
    PixelErrors errors;

    // The picture of one more seed.
    void add(const film::Film& film, const Reference& reference);

    int seeds() const { return errors.seeds(); }
    RootMean rmse() const;
    Limit limit = Limit::none;
};

struct Experiment {
    Settings settings;  // as carried out: N and seeds cut to the budget, threads pinned
    scene::Scene scene;
    std::vector<Reference> references;
    std::vector<Point> points;
    std::uint64_t first_seed = 0;
    double seconds = 0;
    std::vector<int> dropped_Ns;  // for the budget
    bool interrupted = false;     // some points have fewer seeds, or none

    const Reference& reference_of(const Point& point) const;
};

// What a point's error cannot be told apart from: three times the reference's own, or the rounding of radiance to
// floats.
Limit limit_of(const Point& point, const Reference& reference);

// The order of the filter that the estimator asked for order m applies.
int order_of(scene::EstimatorKind kind, int m);

// Whether the estimator's pixels have the filtered picture as expectation and are independent of each other, so that
// the tests of bias apply.
bool unbiased(scene::EstimatorKind kind);

// Whether every seed gives the same picture.
bool deterministic(scene::EstimatorKind kind, const scene::Scene& scene);

// Measures a valid scene's frame. Throws UsageError when the budget does not suffice for anything. Points without any
// render have been removed.
Experiment run_experiment(const scene::Scene& scene, const Settings& settings, cli::ProgressPrinter& progress,
                          const parallel::CancelToken& cancel);

}  // namespace strata::tools::converge
