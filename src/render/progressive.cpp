#include "src/render/progressive.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "src/sample/counter_hash.h"

namespace strata::render {

namespace {

class ProgressiveRender {
  public:
    ProgressiveRender(const integrate::ImageFunction& image, const estimate::EstimatorSettings& settings,
                      const film::Rect& window, const PassGoal& goal, const RenderOptions& options)
        : image_(image), settings_(settings), window_(window), goal_(goal), options_(options) {}

    ProgressiveResult run();

  private:
    RenderResult pass(int number) const;
    void add(RenderResult rendered);
    void predict();
    std::optional<PassesEnd> reached() const;
    parallel::Progress whole_progress(const parallel::Progress& of_pass) const;
    int expected_passes() const;
    void average();
    bool cancel_requested() const { return options_.cancel != nullptr && options_.cancel->requested(); }
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

    const integrate::ImageFunction& image_;
    const estimate::EstimatorSettings& settings_;
    const film::Rect& window_;
    const PassGoal& goal_;
    const RenderOptions& options_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    ProgressiveResult result_;
    PassSum sum_;  // empty while there is one pass
    ErrorMeter meter_;
    double longest_pass_s_ = 0;
};

RenderResult ProgressiveRender::pass(int number) const {
    estimate::EstimatorSettings settings = settings_;
    settings.seed = sample::pass_seed(settings.seed, static_cast<std::uint64_t>(number));
    RenderOptions options = options_;
    options.with_weights = goal_.passes > 1;
    if (options_.on_progress) {
        options.on_progress = [this](const parallel::Progress& progress) {
            options_.on_progress(whole_progress(progress));
        };
    }
    return render::render(image_, estimate::Estimator(settings), window_, options);
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

// Adds a pass that is whole. Of a pair, the first waits in the result's film for the second.
void ProgressiveRender::add(RenderResult rendered) {
    const int number = result_.passes++;
    const film::Film& film = rendered.film;
    if (number == 1) sum_.add(result_.render.film);
    if (number >= 1) sum_.add(film);
    if (number % 2 == 1) meter_.add_pair(result_.render.film, film, sum_);
    result_.render.film = std::move(rendered.film);
    result_.error = meter_.of(sum_);
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
    result_.predicted_passes = static_cast<int>(passes);
    result_.predicted_seconds = passes * pass_s;
}

std::optional<PassesEnd> ProgressiveRender::reached() const {
    if (goal_.target_rmse > 0 && result_.error) {
        if (!std::isfinite(result_.error->rmse)) return PassesEnd::not_finite;
        if (result_.error->high <= goal_.target_rmse) return PassesEnd::target;
    }
    if (result_.passes >= goal_.passes) return PassesEnd::passes;
    if (goal_.time_limit_s > 0 && seconds() + longest_pass_s_ > goal_.time_limit_s) return PassesEnd::time;
    return std::nullopt;
}

void ProgressiveRender::average() {
    if (sum_.passes() == 0) return;
    std::size_t pixel = 0;
    for (int y = window_.y0; y < window_.y1; ++y) {
        for (int x = window_.x0; x < window_.x1; ++x) {
            result_.render.film.finish(x, y, glm::vec3(sum_.mean(pixel++)));
        }
    }
}

ProgressiveResult ProgressiveRender::run() {
    std::optional<PassesEnd> end;
    while (!end) {
        const double pass_start_s = seconds();
        RenderResult rendered = pass(result_.passes);
        RenderResult& all = result_.render;
        all.counters += rendered.counters;
        all.cpu_seconds += rendered.cpu_seconds;
        all.threads = rendered.threads;
        longest_pass_s_ = std::max(longest_pass_s_, seconds() - pass_start_s);
        if (rendered.cancelled) {
            if (result_.passes == 0) all.film = std::move(rendered.film);
            end = PassesEnd::cancelled;
        } else {
            add(std::move(rendered));
            predict();
            end = reached();
            if (!end && cancel_requested()) end = PassesEnd::cancelled;
        }
    }
    result_.end = *end;
    result_.render.cancelled = *end == PassesEnd::cancelled;
    average();
    result_.render.finished_pixels = static_cast<std::int64_t>(result_.render.film.finished_count());
    result_.render.seconds = seconds();
    return std::move(result_);
}

}  // namespace

bool passes_differ(scene::EstimatorKind kind) { return !scene::row_of(kind).is_grid(); }

int bytes_a_pixel_of_passes(const estimate::Estimator& estimator) {
    return estimator.has_random_weights() ? kWeightedPassBytes : kPassBytes;
}

ProgressiveResult render_progressively(const integrate::ImageFunction& image,
                                       const estimate::EstimatorSettings& settings, const film::Rect& window,
                                       const PassGoal& goal, const RenderOptions& options) {
    if (goal.passes < 1 || goal.passes > kMostPasses) throw std::invalid_argument("passes are 1 to 1000000");
    if (goal.passes > 1 && !passes_differ(settings.kind)) {
        throw std::invalid_argument("passes of an estimator without random positions are all alike");
    }
    return ProgressiveRender(image, settings, window, goal, options).run();
}

}  // namespace strata::render
