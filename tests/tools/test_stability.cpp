// The parts of `strata stability` that judge: its oracles, and that what is wrong is seen.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/filter/bspline_oracle.h"
#include "tools/stability/hard_rays.h"
#include "tools/stability/oracles/exact_bspline.h"
#include "tools/stability/ray_jury.h"
#include "tools/stability/report.h"
#include "tools/stability/run.h"

using namespace strata;
using namespace strata::tools::stability;

TEST_CASE("B-splines in exact integers agree with truncated powers in 400 bits") {
    std::mt19937_64 random(1);
    double worst = 0.0;
    for (const int m : {1, 2, 3, 4, 7, 15, 32, 50, 100}) {
        for (int i = 0; i < 8; ++i) {
            const double x = 0.5 * m * std::pow(uniform(random, 0.0, 1.0), 2.0);
            const strata::oracle::ExactSpline found = strata::oracle::exact_spline(m, x);
            const ::oracle::Spline expected = ::oracle::spline(m, x);
            const auto error = [](long double a, const ::oracle::Real& b) {
                return std::abs(static_cast<double>(::oracle::Real(a) / b - 1));
            };
            worst = std::max({worst, error(found.cdf, expected.cdf), error(found.pdf, expected.pdf)});
        }
    }
    // 200 products and quotients, each half an ulp of long double.
    CHECK(worst <= 200 * 0.5 * static_cast<double>(std::numeric_limits<long double>::epsilon()));
    MESSAGE("largest relative difference " << worst);
}

TEST_CASE("the jury sees a hit moved by more than delta, and a hit kept secret") {
    const SceneSpec spec{"hyperterrain", {"film.width=64", "film.height=36", "surface.spin_deg_per_s=0"}};
    const Settings settings;
    RayJury honest(spec, settings), early(spec, settings), secret(spec, settings);
    const auto replay = [] { return std::string(); };
    int hits = 0;
    for (int y = 20; y < 36; ++y) {
        for (int x = 0; x < 64; ++x) {
            const trace::Ray ray = honest.local({.origin = {}, .direction = {}, .pixel = glm::ivec2(x, y)});
            trace::Hit hit = honest.trace({&ray, 1}).front();
            honest.judge_claim(ray, hit, 0.0, replay);
            if (hit.state != trace::HitState::hit) continue;
            ++hits;
            hit.s -= 3.0 * (ray.delta0 + ray.delta_slope * hit.s);
            early.judge_claim(ray, hit, 0.0, replay);
            hit.state = trace::HitState::miss;
            secret.judge_claim(ray, hit, 0.0, replay);
        }
    }
    CHECK(hits > 500);
    CHECK(honest.violations() == 0);
    CHECK(early.violations() >= hits - hits / 100);  // a sliver thinner than delta may lie there
    CHECK(secret.violations() == hits);
    CHECK(secret.violation().find("passed over") == 0);
    CHECK(honest.rows("a").front().pass());
    CHECK_FALSE(early.rows("a").front().pass());
}

TEST_CASE("a jury that saw no hit has shown nothing") {
    const RayJury jury({"terrain", {}}, {});
    CHECK_FALSE(jury.rows("none").front().pass());
}

TEST_CASE("NaN is the worst value, fails a check, and is null in JSON") {
    Worst worst;
    const auto where = [] { return std::string("here"); };
    worst.see(1.0, where);
    worst.see(std::numeric_limits<double>::quiet_NaN(), where);
    worst.see(2.0, where);
    CHECK(std::isnan(worst.value()));
    const std::vector<Row> rows = {{"a", Kind::check, worst.value(), 1.0, "px", "x | y", "g"},
                                   {"b", Kind::check, 1.0, 1.0, "px", "", "g"},
                                   {"c", Kind::information, 7.0, 0.0, "px", "", "g"}};
    CHECK(failures(rows) == 1);
    const std::string json = json_table(rows, {"scalar", 1, false});
    CHECK(json.find("\"measured\": null") != std::string::npos);
    CHECK(json.find("\"pass\": false") != std::string::npos);
    CHECK(markdown_table(rows, {"scalar", 1, false}).find("x \\| y") != std::string::npos);
    CHECK(text_table(rows).find("FAIL  a") != std::string::npos);
}

TEST_CASE("every case of a group keeps its inputs whatever else runs beside it") {
    const auto ignore = [](std::size_t, std::size_t, const Case&) {};
    Settings settings;
    settings.fast = true;
    const std::vector<Row> alone = run_cases(cases_of({"motion"}), settings, 1, ignore);
    const std::vector<Row> together = run_cases(cases_of({"sums", "motion"}), settings, 2, ignore);
    REQUIRE(alone.size() < together.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
        const Row& other = together[together.size() - alone.size() + i];
        CHECK(alone[i].name == other.name);
        CHECK(alone[i].measured == other.measured);
        CHECK(alone[i].detail == other.detail);
    }
}
