#include "tools/bench/run.h"

#include <algorithm>
#include <vector>

#include "tools/bench/memory.h"
#include "tools/bench/peers.h"
#include "tools/job/batch_progress.h"

namespace strata::tools::bench {

namespace {

// Of progress: seconds that a case takes, nearly; the reference tracer's rays cost as much as 40.
double weight_of(const Case& what) {
    const double samples = static_cast<double>(what.scene.sampling.N) * what.scene.sampling.N;
    const double rays = static_cast<double>(what.subset.pixels()) * samples;
    return (what.tracer == integrate::Tracer::reference ? 40 * rays : rays) / what.threads;
}

// One more round of every case, piece by piece in turn. False if cancelled.
bool measure_round(std::vector<Measurement>& measurements, job::BatchProgress& progress,
                   const parallel::CancelToken& cancel) {
    std::vector<CaseRound> rounds;
    std::size_t pieces = 0;
    for (const Measurement& m : measurements) pieces = std::max(pieces, rounds.emplace_back(m.what).pieces());
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        for (std::size_t i = 0; i < rounds.size(); ++i) {
            if (piece >= rounds[i].pieces()) continue;
            const double share = 1.0 / static_cast<double>(rounds[i].pieces());
            const auto show = progress.next(weight_of(measurements[i].what) * share);
            if (!rounds[i].measure_piece(cancel, show)) return false;
        }
    }
    for (std::size_t i = 0; i < rounds.size(); ++i) rounds[i].add_to(measurements[i]);
    return true;
}

}  // namespace

Results run(const Plan& plan, int rounds, const parallel::ProgressCallback& on_progress,
            const parallel::CancelToken& cancel) {
    Results results{.plan = plan};
    double total = 0;
    for (const Case& what : plan.cases) {
        results.measurements.push_back({.what = what});
        total += rounds * weight_of(what);
    }
    std::unique_ptr<Peers> peers;
    if (plan.has(Section::peers)) peers = std::make_unique<Peers>(plan);
    job::BatchProgress batch(total, on_progress);
    std::vector<Measurement> whole_rounds = results.measurements;
    for (int round = 0; round < rounds && !cancel.requested(); ++round) {
        bool finished = measure_round(results.measurements, batch, cancel);
        if (finished && peers) finished = peers->measure_round(cancel);
        if (!finished) break;
        whole_rounds = results.measurements;
        ++results.rounds;
    }
    results.measurements = std::move(whole_rounds);
    if (peers) peers->report(results);
    if (plan.has(Section::memory) && !cancel.requested()) results.memory = measure_memory(plan.settings.quick, cancel);
    if (results.rounds == 0) results.measurements.clear();
    return results;
}

}  // namespace strata::tools::bench
