#include "tools/converge/analysis.h"
#include "tools/report/statistics.h"

#include <algorithm>
#include <cmath>

namespace strata::tools::converge {

namespace {

using scene::EstimatorKind;

constexpr std::size_t kFewestOfAFit = 3;

struct Columns {
    std::vector<double> samples, seconds, rmse, relative_ci;
};

Columns columns_of(const Series& series, int least_N) {
    Columns columns;
    for (const Point* point : series.points) {
        if (point->limit != Limit::none || point->N < least_N) continue;
        const RootMean rmse = point->rmse();
        columns.samples.push_back(1.0 * point->N * point->N);
        columns.seconds.push_back(report::spread_of(point->cpu_seconds).median);
        columns.rmse.push_back(rmse.value);
        columns.relative_ci.push_back(rmse.half_width / rmse.value);
    }
    return columns;
}

void fit(Series& series) {
    // One sample has no strata: its error tells nothing of how the error falls, if there are others.
    Columns columns = columns_of(series, 2);
    if (columns.rmse.size() < kFewestOfAFit) columns = columns_of(series, 1);
    series.against_samples = fit_power_law(columns.samples, columns.rmse, columns.relative_ci);
    series.against_seconds = fit_power_law(columns.seconds, columns.rmse, columns.relative_ci);
    const Columns all = columns_of(series, 1);
    for (std::size_t i = 0; i < kTargets.size(); ++i) {
        series.times[i] = time_to_error(kTargets[i], all.seconds, all.rmse, series.against_seconds);
    }
}

const Series* paper_series(const std::vector<Series>& all, const Series& like) {
    const auto found = std::ranges::find_if(all, [&](const Series& other) {
        return other.estimator == EstimatorKind::stratified && other.m == like.m && other.tracer == like.tracer;
    });
    return found == all.end() ? nullptr : &*found;
}

std::optional<double> error_ratio(const Series& series, const Series& paper) {
    double logarithms = 0;
    int count = 0;
    for (const Point* mine : series.points) {
        for (const Point* other : paper.points) {
            const bool comparable =
                mine->N == other->N && mine->N >= 2 && mine->limit == Limit::none && other->limit == Limit::none;
            if (!comparable) continue;
            logarithms += std::log(mine->rmse().value / other->rmse().value);
            ++count;
        }
    }
    if (count == 0) return std::nullopt;
    return std::exp(logarithms / count);
}

std::vector<Series> group(const Experiment& experiment) {
    std::vector<Series> all;
    for (const Point& point : experiment.points) {
        auto found = std::ranges::find_if(all, [&](const Series& s) {
            return s.estimator == point.estimator && s.m == point.m && s.tracer == point.tracer;
        });
        if (found == all.end()) {
            all.push_back({});
            found = all.end() - 1;
            found->estimator = point.estimator;
            found->m = point.m;
            found->tracer = point.tracer;
        }
        found->points.push_back(&point);
    }
    return all;
}

// Not where float rounding is all the error, since rounding is a bias of its own.
bool testable(const Experiment& experiment, const Point& point) {
    return unbiased(point.estimator) && point.seeds() >= 2 && point.limit != Limit::rounding &&
           experiment.reference_of(point).exact;
}

void test_bias(const Experiment& experiment, Analysis& analysis) {
    for (const Point& point : experiment.points) {
        if (!testable(experiment, point)) continue;
        const Reference& reference = experiment.reference_of(point);
        // Radiance is handed over in floats: half a unit in the last place may be a bias of each sample.
        const double blind = reference.error + reference.root_mean_square * 0x1p-24;
        analysis.tests.push_back({&point, point.errors.z_of_mean(blind), point.errors.z_of_squares(blind), false});
    }
    const std::size_t tests = 2 * analysis.tests.size();
    analysis.mean_threshold = sidak_threshold(analysis.family_level, tests, true);
    analysis.squares_threshold = sidak_threshold(analysis.family_level, tests, false);
    for (BiasTest& test : analysis.tests) {
        test.failed = !(std::fabs(test.z_of_mean) <= analysis.mean_threshold) ||
                      !(test.z_of_squares <= analysis.squares_threshold);
    }
}

}  // namespace

std::optional<double> visible_bias(const Experiment& experiment, const Point& point) {
    if (point.fixed) return point.rmse().value;
    if (point.seeds() < 2) return std::nullopt;
    const bool shared = scene::row_of(point.estimator).is_shared();
    const PixelErrors::SquaredBias bias = point.errors.squared_bias();
    // Shared samples go to m pixels along each axis: so much wider the mean over pixels spreads.
    const double noise = 2 * (shared ? point.m : 1) * bias.standard_error;
    const double reference = experiment.reference_of(point).error;
    const double square = bias.mean - reference * reference;
    if (!(square > std::max(noise, reference * reference))) return std::nullopt;
    return std::sqrt(square);
}

Analysis analyse(const Experiment& experiment) {
    Analysis analysis;
    analysis.series = group(experiment);
    for (Series& series : analysis.series) fit(series);
    for (Series& series : analysis.series) {
        const Series* paper = paper_series(analysis.series, series);
        if (paper == nullptr) continue;
        series.error_ratio = error_ratio(series, *paper);
        for (std::size_t i = 0; i < kTargets.size(); ++i) {
            if (paper->times[i] && series.times[i])
                series.speed_ups[i] = paper->times[i]->seconds / series.times[i]->seconds;
        }
    }
    test_bias(experiment, analysis);
    return analysis;
}

}  // namespace strata::tools::converge
