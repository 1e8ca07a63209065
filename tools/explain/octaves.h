// What each octave of a surface's noise does, by distance from the eye.
#pragma once

#include <string>
#include <vector>

#include "tools/explain/plan.h"

namespace strata::tools::explain {

// Of a scene with a surface.
std::vector<OctavePlan> plan_octaves(const scene::Scene& scene);

// How the tracer treats octaves, in a sentence or two.
std::string octaves_note(const scene::Scene& scene, integrate::Tracer tracer);

}  // namespace strata::tools::explain
