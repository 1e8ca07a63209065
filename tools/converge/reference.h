// What pictures are compared with.
#pragma once

#include "tools/converge/experiment.h"

namespace strata::tools::converge {

// Renders of each half of an engine's reference.
inline constexpr int kPassesOfAHalf = 2;

// The exact picture of order m where there is one; else the engine's at N samples a side with shared Sobol points: the
// mean of two halves of kPassesOfAHalf renders, with seeds of their own, whose difference gives its error. Nothing when
// cancelled.
std::optional<Reference> make_reference(const scene::Scene& scene, int m, int N, int threads,
                                        const parallel::CancelToken& cancel);

// Whether make_reference() will not render.
bool has_exact_reference(const scene::Scene& scene, int m);

}  // namespace strata::tools::converge
