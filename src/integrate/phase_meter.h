// Books an image function's work under its phases.
#pragma once

#include <chrono>

#include "src/integrate/image_function.h"
#include "src/trace/ray.h"

namespace strata::integrate {

class PhaseMeter {
  public:
    explicit PhaseMeter(Counters& counters) : counters_(counters), since_(Clock::now()) {}

    // The time since the last call, or since construction, and that work go to a phase.
    void book(Phase phase, const trace::TraceCounters& work = {}) {
        const Clock::time_point now = Clock::now();
        PhaseCost& cost = counters_.phases[static_cast<std::size_t>(phase)];
        cost.seconds += std::chrono::duration<double>(now - since_).count();
        cost.noise_evaluations += work.noise_evaluations;
        cost.steps += work.steps;
        cost.left_out += work.left_out;
        counters_.noise_evaluations += work.noise_evaluations;
        counters_.executed_lanes += work.executed_lanes;
        counters_.steps += work.steps;
        since_ = now;
    }

    // The time since then is booked elsewhere.
    void skip() { since_ = Clock::now(); }

  private:
    using Clock = std::chrono::steady_clock;
    Counters& counters_;
    Clock::time_point since_;
};

}  // namespace strata::integrate
