// Pictures that grow: independent passes of the estimator over the whole window, added up, until there are as many as
// wanted, the error is as small as wanted, or the time is up.
//
// Pass p is the plain render with the seed sample::pass_seed(seed, p), and a pixel of K passes is their mean, each
// counting by its sum of weights there (pass_sum.h), summed in double in the order of the passes: a pure function of
// (image, settings, K), whatever made it stop at K. One pass is the plain render, to the last bit.
#pragma once

#include <optional>

#include "src/render/error_estimate.h"
#include "src/render/pass_goal.h"
#include "src/render/pass_keeper.h"
#include "src/render/render.h"

namespace strata::render {

enum class PassesEnd { passes, target, time, cancelled, not_finite };

struct ProgressiveResult {
    RenderResult
        render;      // of all passes; its film is complete if one pass is, and `cancelled` says if goals were missed
    int passes = 0;  // whole ones, in the film; 0: the first was cancelled and the film is what it had finished
    PassesEnd end = PassesEnd::passes;
    std::optional<ErrorEstimate> error;   // from two passes on
    std::optional<int> predicted_passes;  // for the target, as seen from the first pair of passes
    double predicted_seconds = 0;         // of the whole, as seen then; 0: never predicted
};

// Throws std::invalid_argument for what render() refuses, and for more than one pass where passes do not differ.
// on_progress tells of the whole: of the predicted passes, or of the time limit where that comes first. A keeper, which
// may be null, takes the place of options.keeper: what it restores counts as rendered, its seconds for the time limit
// too.
ProgressiveResult render_progressively(const integrate::ImageFunction& image,
                                       const estimate::EstimatorSettings& settings, const film::Rect& window,
                                       const PassGoal& goal, const RenderOptions& options = {},
                                       PassKeeper* keeper = nullptr);

}  // namespace strata::render
