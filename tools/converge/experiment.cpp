#include "tools/converge/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "src/integrate/make_image.h"
#include "src/parallel/processors.h"
#include "src/render/render.h"
#include "tools/cli/errors.h"
#include "tools/converge/budget.h"
#include "tools/converge/reference.h"

namespace strata::tools::converge {

namespace {

using scene::EstimatorKind;

constexpr int kSeedsOfPatterns = 16;
constexpr int kSeedsOfScenes = 4;
constexpr double kLeastTimed_s = 2e-3;  // shorter renders are timed several at once
constexpr double kOverhead_s = 2.5e-3;  // of a point besides the render: comparing, timing again
constexpr double kPlannedShare = 0.85;  // of what is left of the budget, since the machine may slow down
constexpr double kReport_s = 4;         // for the report and its plots

class Run {
  public:
    Run(const scene::Scene& scene, const Settings& settings, cli::ProgressPrinter& progress,
        const parallel::CancelToken& cancel)
        : progress_(progress.callback()), cancel_(cancel) {
        all_.settings = settings;
        all_.scene = scene;
        all_.first_seed = scene.sampling.seed;
        window_ = {0, 0, scene.film.width, scene.film.height};
        for (const integrate::Tracer tracer : settings.tracers) images_.push_back(integrate::make_image(scene, tracer));
        if (all_.settings.seeds == 0)
            all_.settings.seeds = scene.image == scene::ImageKind::surface || scene.image == scene::ImageKind::wheel
                                      ? kSeedsOfScenes
                                      : kSeedsOfPatterns;
        reference_threads_ = settings.threads;
        if (settings.threads == 0) all_.settings.threads = 1;
    }

    Experiment run();

  private:
    struct Combination {
        EstimatorKind estimator;
        int m;
        std::size_t tracer;
        double second_a_sample = 0;  // all pixels, N = 1
    };

    void combine();
    void warm_up();
    void fit_budget();
    double cost_s(int N) const;
    double reference_cost_s(int largest_N) const;
    bool make_references();
    void measure();
    void measure(Point& point, int round);
    void show_progress(double done_s, double total_s);
    render::RenderResult render(const Combination& combination, int N, std::uint64_t seed);
    const Combination& combination_of(const Point& point) const;
    int reference_N(int largest) const { return std::clamp(2 * largest, 16, 64); }
    std::vector<int> reference_orders() const;
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    bool out_of_time(double needed_s) const {
        return all_.settings.budget_s > 0 && seconds() + needed_s > all_.settings.budget_s - kReport_s;
    }

    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Experiment all_;
    parallel::ProgressCallback progress_;
    const parallel::CancelToken& cancel_;
    film::Rect window_;
    std::vector<std::unique_ptr<integrate::ImageFunction>> images_;
    std::vector<Combination> combinations_;
    int reference_threads_ = 0;
    std::uint64_t rays_ = 0;
    double before_s_ = 0;  // spent on warming up and references
};

void Run::combine() {
    for (std::size_t tracer = 0; tracer < all_.settings.tracers.size(); ++tracer) {
        for (const EstimatorKind estimator : all_.settings.estimators) {
            std::vector<int> orders = all_.settings.orders;
            if (scene::row_of(estimator).is_box()) orders = {1};
            for (const int m : orders) combinations_.push_back({estimator, m, tracer});
        }
    }
}

render::RenderResult Run::render(const Combination& combination, int N, std::uint64_t seed) {
    all_.scene.sampling.seed = all_.first_seed + seed;
    estimate::EstimatorSettings settings = estimate::estimator_settings(all_.scene);
    all_.scene.sampling.seed = all_.first_seed;
    settings.kind = combination.estimator;
    settings.m = combination.m;
    settings.N = N;
    render::RenderOptions options;
    options.threads = all_.settings.threads;
    options.cancel = &cancel_;
    render::RenderResult result =
        render::render(*images_[combination.tracer], estimate::Estimator(settings), window_, options);
    rays_ += result.counters.rays;
    return result;
}

// Every combination once, with a seed that is not measured: code and tables are in the caches, and what a sample costs
// is known.
void Run::warm_up() {
    constexpr int kPilotN = 4;
    const int N = std::min(kPilotN, all_.settings.Ns.back());
    for (Combination& combination : combinations_) {
        if (cancel_.requested()) return;
        const auto unmeasured = static_cast<std::uint64_t>(all_.settings.seeds);
        const int used_N = scene::row_of(combination.estimator).is_single ? 1 : N;
        combination.second_a_sample = render(combination, used_N, unmeasured).seconds / (used_N * used_N);
    }
}

double Run::cost_s(int N) const {
    double sum = 0;
    for (const Combination& combination : combinations_) {
        if (scene::row_of(combination.estimator).is_single) continue;
        sum += kOverhead_s + combination.second_a_sample * N * N;
    }
    return sum;
}

std::vector<int> Run::reference_orders() const {
    std::vector<int> orders;
    for (const Combination& combination : combinations_) {
        const int order = order_of(combination.estimator, combination.m);
        if (std::ranges::find(orders, order) == orders.end()) orders.push_back(order);
    }
    return orders;
}

double Run::reference_cost_s(int largest_N) const {
    double slowest = 0;  // of those by the tracer that references are made with
    for (const Combination& combination : combinations_) {
        if (all_.settings.tracers[combination.tracer] == integrate::Tracer::fast || all_.settings.tracers.size() == 1)
            slowest = std::max(slowest, combination.second_a_sample);
    }
    double sum = 0;
    for (const int m : reference_orders()) {
        if (!has_exact_reference(all_.scene, m))
            sum += 2 * kPassesOfAHalf * std::pow(reference_N(largest_N), 2) * slowest;
    }
    const double cores = parallel::available_processors();
    return reference_threads_ == 0 ? sum / cores : sum;
}

void Run::fit_budget() {
    Settings& settings = all_.settings;
    if (settings.budget_s <= 0) return;
    const double available_s = kPlannedShare * (settings.budget_s - seconds() - kReport_s);
    const auto plan = plan_budget(
        settings.Ns, settings.seeds, available_s, [this](int N) { return cost_s(N); },
        [this](int N) { return reference_cost_s(N); });
    if (!plan) {
        const int least = settings.Ns.front();
        throw cli::UsageError(fmt::format(
            "--budget: too short: N = {} alone, with two seeds, takes about {}; allowed: more time, a smaller --size, "
            "fewer estimators or orders",
            least, cli::duration_text((reference_cost_s(least) + 2 * cost_s(least)) / kPlannedShare + kReport_s)));
    }
    all_.dropped_Ns.assign(settings.Ns.begin() + static_cast<std::ptrdiff_t>(plan->Ns.size()), settings.Ns.end());
    settings.Ns = plan->Ns;
    settings.seeds = plan->seeds;
}

bool Run::make_references() {
    for (const int m : reference_orders()) {
        auto reference =
            make_reference(all_.scene, m, reference_N(all_.settings.Ns.back()), reference_threads_, cancel_);
        if (!reference) return false;
        all_.references.push_back(std::move(*reference));
    }
    return true;
}

const Run::Combination& Run::combination_of(const Point& point) const {
    return *std::ranges::find_if(combinations_, [&](const Combination& c) {
        return c.estimator == point.estimator && c.m == point.m && all_.settings.tracers[c.tracer] == point.tracer;
    });
}

void Run::measure(Point& point, int round) {
    const int wanted = std::max(all_.settings.repeats, point.fixed ? 1 : all_.settings.seeds);
    if (round >= wanted) return;
    const Combination& combination = combination_of(point);
    if (out_of_time(kOverhead_s + combination.second_a_sample * point.N * point.N)) return;
    const int seed = round % all_.settings.seeds;
    render::RenderResult result = render(combination, point.N, static_cast<std::uint64_t>(seed));
    if (result.cancelled) return;
    double total_s = result.seconds;
    double total_cpu_s = result.cpu_seconds;
    int renders = 1;
    for (; total_s < kLeastTimed_s && renders < 64; ++renders) {
        const render::RenderResult again = render(combination, point.N, static_cast<std::uint64_t>(seed));
        if (again.cancelled) return;
        total_s += again.seconds;
        total_cpu_s += again.cpu_seconds;
    }
    point.seconds.push_back(total_s / renders);
    point.cpu_seconds.push_back(total_cpu_s / renders);
    point.counters = result.counters;
    if (round < all_.settings.seeds && !(point.fixed && round > 0)) point.add(result.film, all_.reference_of(point));
}

void Run::show_progress(double done_s, double total_s) {
    if (progress_) progress_({(before_s_ + done_s) / (before_s_ + total_s), rays_, seconds()});
}

// Round by round, so that whatever disturbs the machine disturbs all points alike.
void Run::measure() {
    for (const int N : all_.settings.Ns) {
        for (const Combination& c : combinations_) {
            if (scene::row_of(c.estimator).is_single && N != all_.settings.Ns.front()) continue;
            Point point;
            point.estimator = c.estimator;
            point.m = c.m;
            point.fixed = deterministic(c.estimator, all_.scene);
            point.N = scene::row_of(c.estimator).is_single ? 1 : N;
            point.tracer = all_.settings.tracers[c.tracer];
            point.errors = PixelErrors(window_.width(), window_.height());
            all_.points.push_back(std::move(point));
        }
    }
    before_s_ = seconds();
    const int rounds = std::max(all_.settings.seeds, all_.settings.repeats);
    double round_s = 0;
    for (const int N : all_.settings.Ns) round_s += cost_s(N);
    for (int round = 0; round < rounds && !cancel_.requested(); ++round) {
        double done_s = round * round_s;
        for (Point& point : all_.points) {
            if (cancel_.requested()) break;
            measure(point, round);
            done_s += kOverhead_s + combination_of(point).second_a_sample * point.N * point.N;
            show_progress(std::min(done_s, rounds * round_s), rounds * round_s);
        }
    }
}

Experiment Run::run() {
    combine();
    warm_up();
    if (!cancel_.requested()) fit_budget();
    if (!cancel_.requested() && make_references()) measure();
    std::erase_if(all_.points, [](const Point& point) { return point.seeds() == 0; });
    for (Point& point : all_.points) point.limit = limit_of(point, all_.reference_of(point));
    all_.interrupted = cancel_.requested();
    all_.seconds = seconds();
    return std::move(all_);
}

}  // namespace

Experiment run_experiment(const scene::Scene& scene, const Settings& settings, cli::ProgressPrinter& progress,
                          const parallel::CancelToken& cancel) {
    return Run(scene, settings, progress, cancel).run();
}

}  // namespace strata::tools::converge
