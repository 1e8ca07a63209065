// All that `strata explain` has to say of a render, and how it says it.
#pragma once

#include <optional>
#include <string>

#include "tools/explain/plan.h"
#include "tools/explain/prediction.h"
#include "tools/explain/recorded.h"

namespace strata::tools::explain {

struct Explanation {
    std::string name;  // of the scene
    scene::Scene scene;
    film::Rect window;
    std::string tracer, simd_target;
    Plan plan;
    Prediction prediction;
    std::optional<Recorded> recorded;
};

// For people, a screenful.
std::string explanation_text(const Explanation& explanation);

// For programs; the form is told by `strata explain --help`.
std::string explanation_json(const Explanation& explanation);

// One cost by its name in both, nothing where it is not known.
struct NamedCost {
    const char* name;
    std::optional<double> predicted, actual;
    std::optional<CountEstimate> between{};  // of counts that a pilot told
    std::optional<double> ratio() const;     // predicted / actual, where both are above zero
};
std::vector<NamedCost> costs_of(const Explanation& explanation);

}  // namespace strata::tools::explain
