#include "src/library/render_setting.h"

#include <fmt/format.h>

#include "src/library/scene_data.h"
#include "src/library/translate.h"
#include "src/parallel/processors.h"
#include "src/render/meter.h"

namespace strata {

namespace {

constexpr int kMostThreads = 1024;  // each has buffers of its own
constexpr int kLargestTile = 1024;  // progress comes by the tile
constexpr double kLeastRmse = 1e-9, kMostRmse = 1e6;
constexpr render::PassWords kWords{"passes", "target_rmse", "time_limit", "or a smaller window"};

int in_range(const char* name, int value, int least, int most) {
    if (value >= least && value <= most) return value;
    throw Error(fmt::format("{}: out of range ({}), allowed: {} to {}", name, value, least, most));
}

film::Rect window_of(const std::optional<Window>& window, const scene::Film& film) {
    if (!window) return {0, 0, film.width, film.height};
    const Window& w = *window;
    const bool is_inside =
        0 <= w.x0 && w.x0 < w.x1 && w.x1 <= film.width && 0 <= w.y0 && w.y0 < w.y1 && w.y1 <= film.height;
    if (is_inside) return {w.x0, w.y0, w.x1, w.y1};
    throw Error(fmt::format("window {},{},{},{}: allowed: x0,y0,x1,y1 with 0 <= x0 < x1 <= {} and 0 <= y0 < y1 <= {}",
                            w.x0, w.y0, w.x1, w.y1, film.width, film.height));
}

render::PassGoal goal_of(const RenderOptions& options, scene::EstimatorKind estimator) {
    const double rmse = options.target_rmse, limit_s = options.time_limit.count();
    if (rmse != 0.0 && !(rmse >= kLeastRmse && rmse <= kMostRmse)) {
        throw Error(fmt::format("target_rmse: out of range ({}), allowed: a linear radiance, {} to {}, or 0", rmse,
                                kLeastRmse, kMostRmse));
    }
    if (!(limit_s >= 0.0)) throw Error(fmt::format("time_limit: out of range ({} s), allowed: 0 s or more", limit_s));
    render::PassRequest request{.target_rmse = rmse, .time_limit_s = limit_s};
    if (options.passes) request.passes = in_range("passes", *options.passes, 1, render::kMostPasses);
    return render::goal_of(request, estimator, kWords);
}

}  // namespace

RenderSetting::RenderSetting(const Scene& scene, const RenderOptions& options) {
    translated([&] {
        scene_ = checked(scene);
        render::take_exposure(scene_);
        window_ = window_of(options.window, scene_.film);
        goal_ = goal_of(options, scene_.sampling.estimator);
        render::check_memory(goal_, estimate::estimator_settings(scene_), window_, parallel::available_memory_bytes(),
                             kWords);
        tracer_ = options.tracer == Tracer::fast ? integrate::Tracer::fast : integrate::Tracer::reference;
        options_.threads = in_range("threads", options.threads, 0, kMostThreads);
        options_.tile = in_range("tile", options.tile, 1, kLargestTile);
        options_.cancel = &cancel_;
        if (options.on_progress) take_progress(options.on_progress);
        stop_.emplace(options.stop, [this] { cancel_.request(); });
    });
}

// What the callback throws must not pass through the tasks, and is not to be taken for an error of the library's own.
void RenderSetting::take_progress(const std::function<void(const Progress&)>& on_progress) {
    options_.on_progress = [this, on_progress](const parallel::Progress& progress) {
        if (callback_failure_) return;
        try {
            on_progress({.fraction = progress.fraction,
                         .rays = progress.rays,
                         .elapsed = std::chrono::duration<double>(progress.seconds),
                         .expected = std::chrono::duration<double>(progress.predicted_seconds())});
        } catch (...) {
            callback_failure_ = std::current_exception();
            cancel_.request();
        }
    };
}

RenderReport report_of(const render::ProgressiveResult& result) {
    const integrate::Counters& counters = result.render.counters;
    RenderReport report;
    report.is_complete = !result.render.cancelled;
    report.passes = result.passes;
    report.finished_pixels = result.render.finished_pixels;
    report.rays = counters.rays;
    report.shadow_rays = counters.shadow_rays;
    report.sky_rays = counters.sky_rays;
    report.water_rays = counters.water_rays;
    report.hits = counters.hits;
    report.unresolved_rays = counters.unresolved_rays;
    report.noise_evaluations = counters.noise_evaluations;
    report.steps = counters.steps;
    report.threads = result.render.threads;
    report.elapsed = std::chrono::duration<double>(result.render.seconds);
    report.cpu_time = std::chrono::duration<double>(result.render.cpu_seconds);
    if (result.error) report.noise_rmse = result.error->rmse;
    return report;
}

}  // namespace strata
