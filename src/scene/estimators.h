// The estimators, in one table: what scene files, options, help texts, experiments and tests know of them. How each one
// places and weighs its samples: src/estimate/estimator.h. References in parentheses are the paper's equations.
//
// A new one is an enumerator and a row here and, unless a placement that is there serves it, a Placement and the
// function that places its samples (src/estimate/estimator.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "src/sample/pattern.h"

namespace strata::scene {

enum class EstimatorKind { none, super, uniform, jittered, stratified, random, sobol, shared, shared_sobol };

// Where samples are, and how they count.
enum class Placement {
    pixel_grid,    // centres of cells of the pixel; equal weights, so that the filter's order is not used
    support_grid,  // centres of cells of the filter's support; weights (2)
    jittered,      // one anywhere in each of these cells; weights (2)
    by_density,    // through the inverse of the filter's distribution; equal weights (3)
    shared,        // anywhere in cells of the screen; a sample counts in every pixel whose support holds it
};

struct EstimatorRow {
    EstimatorKind kind;
    std::string_view name;
    std::string_view meaning;
    Placement placement;
    sample::PatternKind pattern = sample::PatternKind::stratified;  // of samples in the pixel, its support or a cell
    bool is_single = false;                                         // one sample, whatever N

    // Whether samples lie at the same places for every seed.
    constexpr bool is_grid() const {
        return placement == Placement::pixel_grid || placement == Placement::support_grid;
    }
    constexpr bool is_shared() const { return placement == Placement::shared; }

    // Whether pixels are means over their own squares: the B-spline of order 1, whatever m.
    constexpr bool is_box() const { return placement == Placement::pixel_grid && !is_single; }

    // Whether samples count by B-spline weights.
    constexpr bool is_weighed() const {
        return placement == Placement::support_grid || placement == Placement::jittered || is_shared();
    }

    // Whether a pixel's own samples tell the variance of their mean, of N x N > 1 (src/estimate/pixel_channels.h): they
    // count alike and are independent, or one in each of equally likely strata.
    constexpr bool tells_variance() const {
        return placement == Placement::by_density &&
               (pattern == sample::PatternKind::random || pattern == sample::PatternKind::stratified);
    }

    // Whether the expected value of a pixel is the filtered picture's.
    constexpr bool is_unbiased() const { return placement == Placement::by_density; }
};

namespace detail {

using enum EstimatorKind;
using sample::PatternKind;

inline constexpr EstimatorRow kEstimators[] = {
    {none, "none", "one sample at the pixel's centre, at mid-shutter", Placement::pixel_grid, PatternKind::stratified,
     true},
    {super, "super", "centres of N x N cells of the pixel; m is not used", Placement::pixel_grid},
    {uniform, "uniform", "centres of N x N cells of the filter's support, weighed (2)", Placement::support_grid},
    {jittered, "jittered", "one sample anywhere in each of these cells, weighed (2)", Placement::jittered},
    {stratified, "stratified", "one sample in each of N x N strata of probability, the paper's (3)",
     Placement::by_density},
    {random, "random", "N x N independent samples by the filter's density", Placement::by_density, PatternKind::random},
    {sobol, "sobol", "N x N points of a scrambled Sobol sequence by the filter's density", Placement::by_density,
     PatternKind::sobol},
    {shared, "shared", "N x N strata in each cell of the screen, shared by the pixels around it", Placement::shared},
    {shared_sobol, "shared-sobol", "the same with Sobol points in each cell: the least error for its time",
     Placement::shared, PatternKind::sobol},
};

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < std::size(kEstimators); ++i) {
        if (kEstimators[i].kind != static_cast<EstimatorKind>(i)) return false;
    }
    return true;
}
static_assert(is_in_order(), "a row for each enumerator, in their order");

}  // namespace detail

constexpr std::span<const EstimatorRow> all_estimators() { return detail::kEstimators; }

constexpr const EstimatorRow& row_of(EstimatorKind kind) { return detail::kEstimators[static_cast<std::size_t>(kind)]; }

// "random, sobol": those that a predicate of their rows holds for, in the table's order.
template <class Predicate>
std::string names_where(Predicate predicate) {
    std::string names;
    for (const EstimatorRow& row : all_estimators()) {
        if (std::invoke(predicate, row)) names += (names.empty() ? "" : ", ") + std::string(row.name);
    }
    return names;
}

}  // namespace strata::scene
