#include "src/render/pass_goal.h"

#include <fmt/format.h>

#include <stdexcept>

namespace strata::render {

namespace {

// What asks for several passes.
const char* asked_by(const PassGoal& goal, const PassWords& words) {
    if (goal.target_rmse > 0) return words.target_rmse;
    return goal.time_limit_s > 0 ? words.time_limit : words.passes;
}

}  // namespace

bool passes_differ(scene::EstimatorKind kind) { return !scene::row_of(kind).is_grid(); }

int bytes_a_pixel_of_passes(const estimate::Estimator& estimator) {
    return estimator.has_random_weights() ? kWeightedPassBytes : kPassBytes;
}

PassGoal goal_of(const PassRequest& request, scene::EstimatorKind estimator, const PassWords& words) {
    const PassGoal goal{request.passes.value_or(request.is_open_ended() ? kMostPasses : 1), request.target_rmse,
                        request.time_limit_s};
    if (goal.passes > 1 && !passes_differ(estimator)) {
        throw std::invalid_argument(
            fmt::format("{}: passes of the estimator '{}' are all alike, their mean is no better than one; allowed "
                        "with passes: {}",
                        asked_by(goal, words), scene::row_of(estimator).name,
                        scene::names_where([](const scene::EstimatorRow& row) { return passes_differ(row.kind); })));
    }
    return goal;
}

void check_memory(const PassGoal& goal, const estimate::EstimatorSettings& settings, const film::Rect& window,
                  std::uint64_t present_bytes, const PassWords& words) {
    if (goal.passes == 1) return;
    const double needed =
        1.0 * bytes_a_pixel_of_passes(estimate::Estimator(settings)) * window.width() * window.height();
    const double present = static_cast<double>(present_bytes);
    if (needed <= present) return;
    throw std::invalid_argument(fmt::format(
        "{}: {}x{} pixels in passes need {:.1f} GB of memory, there are {:.1f} GB (of this machine, or of its "
        "container); allowed: one pass, {}",
        asked_by(goal, words), window.width(), window.height(), needed / 1e9, present / 1e9, words.smaller));
}

}  // namespace strata::render
