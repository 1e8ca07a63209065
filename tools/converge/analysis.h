// What an experiment says: slopes, times to reach an error, tests of bias.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "tools/converge/experiment.h"
#include "tools/converge/power_law.h"

namespace strata::tools::converge {

inline constexpr std::array<double, 3> kTargets{1.0 / 64, 1.0 / 256, 1.0 / 1024};

// The points of one estimator, order and tracer, N ascending.
struct Series {
    scene::EstimatorKind estimator{};
    int m = 0;
    integrate::Tracer tracer{};
    std::vector<const Point*> points;
    std::optional<PowerLaw> against_samples;  // RMSE against N * N; without limited points
    std::optional<PowerLaw> against_seconds;  // of CPU: what the clock says depends on who else uses the machine
    std::array<std::optional<TimeToError>, kTargets.size()> times;
    std::array<std::optional<double>, kTargets.size()> speed_ups;  // the time of `stratified` over this one's
    std::optional<double> error_ratio;  // RMSE over that of `stratified` at the same N: geometric mean, N >= 2
};

// The tests of one point of an unbiased estimator against an exact picture.
struct BiasTest {
    const Point* point = nullptr;
    double z_of_mean = 0, z_of_squares = 0;
    bool failed = false;
};

struct Analysis {
    std::vector<Series> series;
    std::vector<BiasTest> tests;  // empty where there is no exact picture
    double family_level = 0.01;   // that an unbiased estimator fails anywhere
    double mean_threshold = 0, squares_threshold = 0;
};

// The root of the mean square of a point's bias over pixels, where it stands out of noise and the reference's own
// error.
std::optional<double> visible_bias(const Experiment& experiment, const Point& point);

// Points into the experiment, which must outlive it.
Analysis analyse(const Experiment& experiment);

}  // namespace strata::tools::converge
