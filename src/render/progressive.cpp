#include "src/render/progressive.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "src/render/render_context.h"
#include "src/sample/counter_hash.h"

namespace strata::render {

namespace {

class ProgressiveRender {
  public:
    ProgressiveRender(const integrate::ImageFunction& image, const estimate::EstimatorSettings& settings,
                      const film::Rect& window, const PassGoal& goal, const RenderOptions& options, PassKeeper* keeper)
        : image_(image), settings_(settings), window_(window), goal_(goal), options_(options), keeper_(keeper) {}

    ProgressiveResult run();

  private:
    RenderOptions pass_options() const;
    RenderResult pass();
    void restore();
    void add();
    void predict();
    std::optional<PassesEnd> reached() const;
    parallel::Progress whole_progress(const parallel::Progress& of_pass) const;
    int expected_passes() const;
    void average();
    bool cancel_requested() const { return options_.cancel != nullptr && options_.cancel->requested(); }
    double own_seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    double seconds() const { return so_far_.seconds + own_seconds(); }

    const integrate::ImageFunction& image_;
    const estimate::EstimatorSettings& settings_;
    const film::Rect& window_;
    const PassGoal& goal_;
    const RenderOptions& options_;
    PassKeeper* keeper_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    ProgressiveResult result_;
    PassesSoFar so_far_;
    film::Film pass_;  // in work
};

RenderOptions ProgressiveRender::pass_options() const {
    RenderOptions options = options_;
    options.with_weights = goal_.passes > 1;
    options.keeper = keeper_;
    if (options_.on_progress) {
        options.on_progress = [this](const parallel::Progress& progress) {
            options_.on_progress(whole_progress(progress));
        };
    }
    return options;
}

RenderResult ProgressiveRender::pass() {
    estimate::EstimatorSettings settings = settings_;
    settings.seed = sample::pass_seed(settings.seed, static_cast<std::uint64_t>(so_far_.passes));
    const estimate::Estimator estimator(settings);
    const RenderOptions options = pass_options();
    check_renderable(window_, options);
    pass_ = film::Film(window_, film_extras(options, estimator));
    if (keeper_ != nullptr) keeper_->begin_pass(so_far_, pass_);
    return render_strips(image_, estimator, window_, options, kWholeFilmStrip,
                         [&](const film::Film& strip) { pass_.paste(strip); });
}

void ProgressiveRender::restore() {
    if (keeper_ == nullptr) return;
    const film::FilmExtras extras = film_extras(pass_options(), estimate::Estimator(settings_));
    if (auto earlier = keeper_->restore(window_, extras)) so_far_ = std::move(*earlier);
    result_.passes = so_far_.passes;
    result_.predicted_passes = so_far_.predicted_passes;
    result_.predicted_seconds = so_far_.predicted_seconds;
    result_.error = so_far_.meter.of(so_far_.sum);
}

int ProgressiveRender::expected_passes() const {
    if (goal_.target_rmse <= 0) return goal_.passes;
    constexpr int kLeastForTarget = 4;
    return std::clamp(result_.predicted_passes.value_or(kLeastForTarget), std::min(result_.passes + 1, goal_.passes),
                      goal_.passes);
}

parallel::Progress ProgressiveRender::whole_progress(const parallel::Progress& of_pass) const {
    const double now_s = seconds();
    double fraction = (result_.passes + of_pass.fraction) / expected_passes();
    if (goal_.time_limit_s > 0) fraction = std::max(fraction, now_s / goal_.time_limit_s);
    return {std::min(fraction, 1.0), result_.render.counters.rays + of_pass.rays, now_s};
}

// Adds the pass in work, which is whole.
void ProgressiveRender::add() {
    const int number = so_far_.passes++;
    if (number == 1) so_far_.sum.add(so_far_.last);
    if (number >= 1) so_far_.sum.add(pass_);
    if (number % 2 == 1) so_far_.meter.add_pair(so_far_.last, pass_, so_far_.sum);
    so_far_.last = std::move(pass_);
    result_.passes = so_far_.passes;
    result_.error = so_far_.meter.of(so_far_.sum);
}

// Once, from what two passes show.
void ProgressiveRender::predict() {
    if (result_.passes != 2) return;
    double passes = goal_.passes;
    if (goal_.target_rmse > 0) {
        const double ratio = result_.error->rmse / goal_.target_rmse;
        passes = std::min(passes, std::max(4.0, 2 * std::ceil(ratio * ratio)));
    }
    const double pass_s = seconds() / 2;
    if (goal_.time_limit_s > 0) passes = std::clamp(std::floor(goal_.time_limit_s / pass_s), 2.0, passes);
    if (!(passes >= 1)) return;  // not a number
    result_.predicted_passes = so_far_.predicted_passes = static_cast<int>(passes);
    result_.predicted_seconds = so_far_.predicted_seconds = passes * pass_s;
}

std::optional<PassesEnd> ProgressiveRender::reached() const {
    if (goal_.target_rmse > 0 && result_.error) {
        if (!std::isfinite(result_.error->rmse)) return PassesEnd::not_finite;
        if (result_.error->high <= goal_.target_rmse) return PassesEnd::target;
    }
    if (result_.passes >= goal_.passes) return PassesEnd::passes;
    if (goal_.time_limit_s > 0 && seconds() + so_far_.longest_pass_s > goal_.time_limit_s) return PassesEnd::time;
    return std::nullopt;
}

void ProgressiveRender::average() {
    result_.render.film = std::move(so_far_.passes == 0 ? pass_ : so_far_.last);
    if (so_far_.sum.passes() == 0) return;
    // An even number of passes that an earlier process finished left no film of the last.
    if (result_.render.film.pixels().empty()) result_.render.film = film::Film(window_);
    std::size_t pixel = 0;
    for (int y = window_.y0; y < window_.y1; ++y) {
        for (int x = window_.x0; x < window_.x1; ++x) {
            result_.render.film.finish(x, y, glm::vec3(so_far_.sum.mean(pixel++)));
        }
    }
}

ProgressiveResult ProgressiveRender::run() {
    restore();
    std::optional<PassesEnd> end;
    if (so_far_.passes > 0) end = reached();
    while (!end) {
        const double pass_start_s = seconds();
        const RenderResult rendered = pass();
        RenderResult& all = result_.render;
        all.counters += rendered.counters;
        all.cpu_seconds += rendered.cpu_seconds;
        all.threads = rendered.threads;
        so_far_.longest_pass_s = std::max(so_far_.longest_pass_s, seconds() - pass_start_s);
        if (rendered.cancelled) {
            end = PassesEnd::cancelled;
        } else {
            add();
            predict();
            end = reached();
            if (!end && cancel_requested()) end = PassesEnd::cancelled;
        }
    }
    if (*end == PassesEnd::cancelled && keeper_ != nullptr) keeper_->stop();
    result_.end = *end;
    result_.render.cancelled = *end == PassesEnd::cancelled;
    average();
    result_.render.finished_pixels = static_cast<std::int64_t>(result_.render.film.finished_count());
    result_.render.seconds = own_seconds();
    return std::move(result_);
}

}  // namespace

ProgressiveResult render_progressively(const integrate::ImageFunction& image,
                                       const estimate::EstimatorSettings& settings, const film::Rect& window,
                                       const PassGoal& goal, const RenderOptions& options, PassKeeper* keeper) {
    if (goal.passes < 1 || goal.passes > kMostPasses) throw std::invalid_argument("passes are 1 to 1000000");
    if (goal.passes > 1 && !passes_differ(settings.kind)) {
        throw std::invalid_argument("passes of an estimator without random positions are all alike");
    }
    return ProgressiveRender(image, settings, window, goal, options, keeper).run();
}

}  // namespace strata::render
