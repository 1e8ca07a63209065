#include "src/render/pass_goal.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "tests/support/estimators.h"

using namespace strata;
using namespace strata::render;

namespace {

constexpr PassWords kWords{"the passes", "the target", "the limit", "a smaller one"};

// What action() is refused with; empty: it is not.
template <class Action>
std::string refusal_of(const Action& action) {
    try {
        action();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("more than one pass is refused of grids alone, with what asked for it and every estimator that has passes") {
    for (const scene::EstimatorRow& row : scene::all_estimators()) {
        const auto refusal = [&](const PassRequest& request) {
            return refusal_of([&] { goal_of(request, row.kind, kWords); });
        };
        CHECK(refusal({}).empty());
        CHECK(refusal({.passes = 1, .target_rmse = 0.1}).empty());
        CHECK(refusal({.passes = 2}).empty() == !row.is_grid());
        if (!row.is_grid()) continue;
        CHECK(refusal({.passes = 2}).starts_with("the passes: "));
        CHECK(refusal({.time_limit_s = 1}).starts_with("the limit: "));
        const std::string text = refusal({.target_rmse = 0.1, .time_limit_s = 1});
        CHECK(text.starts_with("the target: "));
        const std::string allowed = text.substr(text.find("allowed")) + ",";
        for (const scene::EstimatorRow& other : scene::all_estimators()) {
            CHECK(has(allowed, " " + std::string(other.name) + ",") == !other.is_grid());
        }
    }
}

TEST_CASE("passes are those asked for, else as many as it takes to a target or a time, else one") {
    const auto passes = [](const PassRequest& request) {
        return goal_of(request, scene::EstimatorKind::random, kWords).passes;
    };
    CHECK(passes({}) == 1);
    CHECK(passes({.passes = 7}) == 7);
    CHECK(passes({.passes = 7, .target_rmse = 0.1}) == 7);
    CHECK(passes({.target_rmse = 0.1}) == kMostPasses);
    CHECK(passes({.time_limit_s = 1}) == kMostPasses);
}

TEST_CASE("passes fit into their bytes a pixel and not into one less, and one pass is never refused") {
    for (const scene::EstimatorKind kind :
         support::estimators_where([](const scene::EstimatorRow& row) { return passes_differ(row.kind); })) {
        const estimate::EstimatorSettings settings{kind, 2, 4, 1, 1, {}};
        const film::Rect window{100, 200, 1100, 700};
        const auto bytes = 500'000 * static_cast<std::uint64_t>(bytes_a_pixel_of_passes(estimate::Estimator(settings)));
        const auto refusal = [&](int passes, std::uint64_t present) {
            return refusal_of([&] { check_memory({passes, 0, 0}, settings, window, present, kWords); });
        };
        CHECK(refusal(2, bytes).empty());
        CHECK(has(refusal(2, bytes - 1), "the passes: 1000x500 pixels"));
        CHECK(has(refusal(2, bytes - 1), "one pass, a smaller one"));
        CHECK(refusal(1, 0).empty());
    }
}
