#include "tools/bench/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "tools/report/statistics.h"

namespace strata::tools::bench {

double pick_of(const std::vector<double>& values, Pick pick) {
    if (values.empty()) return 0;
    return pick == Pick::least ? *std::ranges::min_element(values) : report::spread_of(values).median;
}

double Measurement::ns_an_evaluation(Pick pick) const {
    return counters.noise_evaluations == 0 ? 0 : ns_a_ray(pick) / evaluations_a_ray();
}

struct CaseRound::State {
    const Case& what;
    std::unique_ptr<integrate::ImageFunction> image = integrate::make_image(what.scene, what.tracer);
    estimate::Estimator estimator{estimate::estimator_settings(what.scene)};
    std::size_t next = 0;
    integrate::Counters counters{};
    double cpu_s = 0, wall_s = 0;
    std::vector<Phase> phases{};
};

CaseRound::CaseRound(const Case& what) : state_(new State{what}) {}
CaseRound::~CaseRound() = default;
CaseRound::CaseRound(CaseRound&&) noexcept = default;

std::size_t CaseRound::pieces() const { return state_->what.subset.windows.size(); }

bool CaseRound::measure_piece(const parallel::CancelToken& cancel, const parallel::ProgressCallback& on_progress) {
    State& round = *state_;
    render::RenderOptions options;
    options.threads = round.what.threads;
    options.cancel = &cancel;
    options.on_progress = on_progress;
    const render::RenderResult result =
        render::render(*round.image, round.estimator, round.what.subset.windows.at(round.next++), options);
    if (result.cancelled) return false;
    round.counters += result.counters;
    round.cpu_s += result.cpu_seconds;
    round.wall_s += result.seconds;
    add_phases(round.phases, phases_of(result));
    return true;
}

void CaseRound::add_to(Measurement& measurement) const {
    const State& round = *state_;
    assert(round.next == pieces());
    if (!measurement.cpu_s.empty() && !integrate::same_counts(round.counters, measurement.counters)) {
        throw std::runtime_error(
            fmt::format("{}: two rounds of the same render did different work", measurement.what.id()));
    }
    if (measurement.cpu_s.empty() || round.cpu_s < pick_of(measurement.cpu_s, Pick::least)) {
        measurement.phases = round.phases;
    }
    measurement.counters = round.counters;
    measurement.cpu_s.push_back(round.cpu_s);
    measurement.wall_s.push_back(round.wall_s);
}

const Measurement* find(const std::vector<Measurement>& all, const std::string& id) {
    const auto found =
        std::ranges::find_if(all, [&](const Measurement& m) { return !m.cpu_s.empty() && m.what.id() == id; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace strata::tools::bench
