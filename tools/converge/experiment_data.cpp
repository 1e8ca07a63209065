#include <algorithm>

#include "tools/converge/experiment.h"

namespace strata::tools::converge {

using scene::EstimatorKind;

int order_of(EstimatorKind kind, int m) { return kind == EstimatorKind::super ? 1 : m; }

RootMean ConvergePoint::rmse() const { return root_mean(mean_squares, fixed); }

const ConvergeReference& Experiment::reference_of(const ConvergePoint& point) const {
    const int order = order_of(point.estimator, point.m);
    return *std::ranges::find_if(references, [order](const ConvergeReference& r) { return r.m == order; });
}

bool unbiased(EstimatorKind kind) {
    return kind == EstimatorKind::stratified || kind == EstimatorKind::random || kind == EstimatorKind::sobol;
}

bool deterministic(EstimatorKind kind, const scene::Scene& scene) {
    if (kind == EstimatorKind::none) return true;
    const bool instant = !(scene.shutter.open_s > 0);
    return instant && (kind == EstimatorKind::super || kind == EstimatorKind::uniform);
}

}  // namespace strata::tools::converge
