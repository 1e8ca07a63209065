// What the paper's own numerics do, for comparison: Newton's iteration and truncated powers. Information, not checks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/filter/bspline.h"
#include "src/filter/bspline_paper.h"
#include "tools/stability/case.h"
#include "tools/stability/oracles/exact_bspline.h"

namespace strata::tools::stability {

namespace {

constexpr int kPaperMost = 8;  // "always <= 8 iterations"

// By plain recursion up to m = 8, above on the values of the triangle: the recursion costs 2^m.
filter::paper::PaperInversion paper_inverse(int m, double y, int most_iterations) {
    constexpr double kTolerance = filter::paper::kTolerance;
    return m <= 8 ? filter::paper::inverse_cdf(m, y, kTolerance, most_iterations)
                  : filter::paper::inverse_cdf_fast(m, y, kTolerance, most_iterations);
}

std::vector<Row> newton(int m, const Settings& settings, Random& random) {
    Worst most, cost, tail_cost;
    int more = 0, lost = 0;
    const int draws = settings.trials(20000, 500);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const auto replay = [&](double y) { return fmt::format("y = {:.17g}", y); };
    const auto stop_at_8 = [&](double y) {
        return std::abs(paper_inverse(m, y, kPaperMost).x - filter::bspline_inverse_cdf(m, y));
    };
    for (int i = 0; i < draws && !settings.cancelled(); ++i) {
        const double y = uniform(random);
        const filter::paper::PaperInversion found = paper_inverse(m, y, filter::paper::kMaxIterations);
        more += found.iterations > kPaperMost || !found.converged;
        lost += !found.converged;
        most.see(found.iterations, [&] { return replay(y); });
        cost.see(stop_at_8(y), [&] { return replay(y); });
    }
    Worst in_tail;
    for (const double y : {1e-4, 1e-6, 1e-8, 1e-12, 1.0 - 0x1p-53}) {
        const filter::paper::PaperInversion found = paper_inverse(m, y, filter::paper::kMaxIterations);
        in_tail.see(found.converged ? found.iterations : filter::paper::kMaxIterations, [&] { return replay(y); });
        tail_cost.see(stop_at_8(y), [&] { return replay(y); });
    }
    const std::string name = fmt::format("the paper's Newton, m = {}: ", m);
    const auto row = [&](const std::string& what, double measured, const char* unit, const std::string& detail) {
        return information(name + what, measured, unit, detail);
    };
    return {row("uniform y that need more than 8 steps", 100.0 * more / draws, "%",
                fmt::format("{} of {}; {} never converge", more, draws, lost)),
            row("most steps, uniform y", most.value(), "steps", most.where()),
            row("error when stopped at 8, uniform y", cost.value(), "px", cost.where()),
            row("most steps, y from 1e-12 to 1 - 2^-53", in_tail.value(), "steps", in_tail.where()),
            row("error when stopped at 8, these y", tail_cost.value(), "px", tail_cost.where())};
}

// (A.3) as it stands, in Real.
template <class Real>
Real truncated_power_density(int m, double x) {
    Real sum = 0, binomial = 1, factorial = 1;
    for (int k = 0; k <= m && k < x; ++k) {
        const Real term = binomial * std::pow(static_cast<Real>(x) - static_cast<Real>(k), static_cast<Real>(m - 1));
        sum += k % 2 == 0 ? term : -term;
        binomial = binomial * static_cast<Real>(m - k) / static_cast<Real>(k + 1);
    }
    for (int k = 2; k < m; ++k) factorial *= static_cast<Real>(k);
    return sum / factorial;
}

double relative_error(long double found, long double exact) { return static_cast<double>(std::abs(found / exact - 1)); }

// The least order at which a sum of truncated powers is off by as much as the value itself somewhere on the support,
// and by 1 %; beside it the largest error of the triangle up to order 100 at the same points.
std::vector<Row> truncated_powers(const Settings& settings, Random&) {
    int lost_float = 0, lost_double = 0, percent_float = 0, percent_double = 0;
    Worst triangle;
    for (int m = 2; m <= 100 && !settings.cancelled(); m += settings.fast && m >= 40 ? 20 : 1) {
        Worst in_float, in_double;
        for (int i = 1; i < 16; ++i) {
            const double x = m * (i / 16.0);
            const long double exact = oracle::exact_spline(m, x < 0.5 * m ? x : m - x).pdf;
            const auto where = [&] { return fmt::format("m = {}, x = {:.17g}", m, x); };
            in_float.see(relative_error(static_cast<long double>(truncated_power_density<float>(m, x)), exact), where);
            in_double.see(relative_error(static_cast<long double>(truncated_power_density<double>(m, x)), exact),
                          where);
            triangle.see(relative_error(static_cast<long double>(filter::bspline_pdf(m, x)), exact), where);
        }
        const auto first = [&](int& order, const Worst& worst, double limit) {
            if (order == 0 && !(worst.value() < limit)) order = m;
        };
        first(percent_float, in_float, 0.01);
        first(percent_double, in_double, 0.01);
        first(lost_float, in_float, 1.0);
        first(lost_double, in_double, 1.0);
    }
    const auto row = [&](const char* name, int order) {
        return information(name, static_cast<double>(order), "order m", "at x = m i / 16, i = 1..15");
    };
    return {row("truncated powers in float: 1 % off from", percent_float),
            row("truncated powers in float: no digit left from", lost_float),
            row("truncated powers in double: 1 % off from", percent_double),
            row("truncated powers in double: no digit left from", lost_double),
            check("the triangle at the same points, m = 2..100", triangle, 16 * 0x1p-52, "relative")};
}

}  // namespace

void add_paper_cases(std::vector<Case>& cases) {
    for (const int m : {2, 3, 4, 8, 15, 20, 50, 100}) {
        cases.push_back({"bspline", fmt::format("the paper's Newton, m = {}", m),
                         [=](const Settings& s, Random& r) { return newton(m, s, r); }});
    }
    cases.push_back({"bspline", "truncated powers", truncated_powers});
}

}  // namespace strata::tools::stability
