#include "tools/bench/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "src/render/make_image.h"
#include "src/render/render.h"
#include "tools/converge/statistics.h"

namespace strata::tools::bench {

namespace {

struct Round {
    render::Counters counters;
    double cpu_s = 0, wall_s = 0;
    std::vector<Phase> phases;
};

bool same_work(const render::Counters& a, const render::Counters& b) {
    return a.rays == b.rays && a.shadow_rays == b.shadow_rays && a.hits == b.hits &&
           a.noise_evaluations == b.noise_evaluations && a.steps == b.steps;
}

// The image function is made anew each time: nothing that it may remember makes a later round cheaper.
bool render_windows(const Case& what, const render::CancelToken& cancel, const render::ProgressCallback& on_progress,
                    Round& round) {
    const auto image = render::make_image(what.scene, what.tracer);
    const render::Estimator estimator(render::estimator_settings(what.scene));
    render::RenderOptions options;
    options.threads = what.threads;
    options.cancel = &cancel;
    const double total = static_cast<double>(what.subset.pixels());
    double done = 0;
    for (const render::Window& window : what.subset.windows) {
        const double share = static_cast<double>(window.width()) * window.height() / total;
        options.on_progress = [&](const render::Progress& progress) {
            on_progress({done + share * progress.fraction, round.counters.rays + progress.rays,
                         round.wall_s + progress.seconds});
        };
        const render::RenderResult result = render::render(*image, estimator, window, options);
        if (result.cancelled) return false;
        done += share;
        round.counters += result.counters;
        round.cpu_s += result.cpu_seconds;
        round.wall_s += result.seconds;
        add_phases(round.phases, phases_of(result));
    }
    return true;
}

}  // namespace

double pick_of(const std::vector<double>& values, Pick pick) {
    if (values.empty()) return 0;
    return pick == Pick::least ? *std::ranges::min_element(values) : spread_of(values).median;
}

double Measurement::ns_an_evaluation(Pick pick) const {
    return counters.noise_evaluations == 0 ? 0 : ns_a_ray(pick) / evaluations_a_ray();
}

bool measure_round(Measurement& measurement, const render::CancelToken& cancel,
                   const render::ProgressCallback& on_progress) {
    Round round;
    if (!render_windows(measurement.what, cancel, on_progress, round)) return false;
    if (!measurement.cpu_s.empty() && !same_work(round.counters, measurement.counters)) {
        throw std::runtime_error(
            fmt::format("{}: two rounds of the same render did different work", measurement.what.id()));
    }
    if (measurement.cpu_s.empty() || round.cpu_s < pick_of(measurement.cpu_s, Pick::least)) {
        measurement.phases = std::move(round.phases);
    }
    measurement.counters = round.counters;
    measurement.cpu_s.push_back(round.cpu_s);
    measurement.wall_s.push_back(round.wall_s);
    return true;
}

const Measurement* find(const std::vector<Measurement>& all, const std::string& id) {
    const auto found =
        std::ranges::find_if(all, [&](const Measurement& m) { return !m.cpu_s.empty() && m.what.id() == id; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace strata::tools::bench
