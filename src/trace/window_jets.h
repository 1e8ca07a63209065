// Fills in windows' polynomials: values, gradients and Hessians of sums of octaves, a window each lane.
#pragma once

#include <span>

#include "src/trace/field.h"
#include "src/trace/ray.h"
#include "src/trace/trace_plan.h"
#include "src/trace/window.h"

namespace strata::trace {

class WindowJets {
  public:
    explicit WindowJets(const Field& field) : field_(field) {}

    // Sets value, gradient and hessian from centre and octaves.
    void evaluate(std::span<Window> windows, TraceCounters& counters) const;

  private:
    const Field& field_;
};

}  // namespace strata::trace
