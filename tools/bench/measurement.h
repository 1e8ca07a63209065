// A case as it was measured: counts, which are the same every time, and times, one a round.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/integrate/image_function.h"
#include "tools/bench/case.h"
#include "tools/bench/phases.h"

namespace strata::tools::bench {

// Which of the rounds' times is taken.
enum class Pick { least, median };

double pick_of(const std::vector<double>& values, Pick pick);

struct Measurement {
    Case what;
    integrate::Counters counters{};
    std::vector<double> cpu_s{};   // of all threads
    std::vector<double> wall_s{};  // by the clock
    std::vector<Phase> phases{};   // of the fastest round

    double rays() const { return static_cast<double>(counters.rays); }
    // The camera's, and all that it led to: to suns, the sky, into water.
    double rays_a_sample() const {
        const integrate::Counters& c = counters;
        return static_cast<double>(c.rays + c.shadow_rays + c.sky_rays + c.water_rays) / rays();
    }
    double ns_a_ray(Pick pick) const { return 1e9 * pick_of(cpu_s, pick) / rays(); }
    double evaluations_a_ray() const { return static_cast<double>(counters.noise_evaluations) / rays(); }
    double steps_a_ray() const { return static_cast<double>(counters.steps) / rays(); }
    double ns_an_evaluation(Pick pick) const;
};

// One more round of a case, in the pieces that its subset has, so that the cases of a run can take turns: ratios of
// their times then owe little to what else the machine is doing.
class CaseRound {
  public:
    // The image function is made anew: nothing that it may remember makes a later round cheaper. `what` must outlive
    // the round.
    explicit CaseRound(const Case& what);
    explicit CaseRound(Case&&) = delete;
    ~CaseRound();
    CaseRound(CaseRound&&) noexcept;

    std::size_t pieces() const;

    // Each once, in order. False, and the round is void, if cancelled.
    bool measure_piece(const parallel::CancelToken& cancel, const parallel::ProgressCallback& on_progress);

    // Adds the round, all of whose pieces are measured, to the case's. Throws std::runtime_error if its counts are not
    // those of the rounds before: equal renders do equal work.
    void add_to(Measurement& measurement) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// The one with this id; nullptr if there is none, or it has no round.
const Measurement* find(const std::vector<Measurement>& all, const std::string& id);

}  // namespace strata::tools::bench
