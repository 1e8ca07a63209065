// What a scene pays for features that it does not use, where counts cannot show it: CPU time, one thread. The two sides
// of a pair take turns, so that a shared machine slows both; `ratio` is the median of the turns' ratios, second over
// first, `low` and `high` the quartiles, `first_ns` and `second_ns` the least nanoseconds a ray.
//
//   bare/...      the renderer, for a scene without motion, shadows and haze, over a loop of the stages that this needs
//   unused/...    a scene that names the feature where it does nothing, over one that does not name it
//   used/...      the feature at work, over the same scene without: what leaving it out saves
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src/integrate/light.h"
#include "src/integrate/make_image.h"
#include "src/integrate/place.h"
#include "src/integrate/resolve.h"
#include "src/integrate/surface_integrator.h"
#include "src/integrate/trace_rays.h"
#include "src/parallel/cpu_clock.h"
#include "src/render/render.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "tools/report/statistics.h"

namespace {

using namespace strata;

constexpr int kWidth = 192, kHeight = 108;

double timed(const std::function<void()>& work) {
    const double start = parallel::thread_cpu_seconds();
    work();
    return parallel::thread_cpu_seconds() - start;
}

void run_pair(benchmark::State& state, double rays, const std::function<void()>& first,
              const std::function<void()>& second) {
    std::vector<double> first_s, second_s, ratios;
    bool first_leads = true;
    for (auto _ : state) {
        if (!first_leads) second_s.push_back(timed(second));
        first_s.push_back(timed(first));
        if (first_leads) second_s.push_back(timed(second));
        first_leads = !first_leads;
        ratios.push_back(second_s.back() / first_s.back());
    }
    const tools::report::Spread ratio = tools::report::spread_of(ratios);
    state.counters["ratio"] = ratio.median;
    state.counters["low"] = ratio.low_quartile;
    state.counters["high"] = ratio.high_quartile;
    state.counters["first_ns"] = 1e9 * *std::ranges::min_element(first_s) / rays;
    state.counters["second_ns"] = 1e9 * *std::ranges::min_element(second_s) / rays;
}

scene::Scene builtin(const char* name) {
    scene::Scene scene = scene::read_scene(scene::find_builtin(name)->text, name);
    scene.film.width = kWidth;
    scene.film.height = kHeight;
    scene.sampling.N = 2;
    scene.sampling.estimator = scene::EstimatorKind::stratified;
    return scene;
}

scene::Scene plain(const char* name) {
    scene::Scene scene = builtin(name);
    scene.sun.shadows = false;
    scene.sky.haze_distance = 0.0;
    return scene;
}

// Only the stages that a picture without shadows, haze and channels needs.
class BareImage final : public integrate::ImageFunction {
  public:
    explicit BareImage(const scene::Scene& scene) : setup_(scene, integrate::Tracer::fast, trace::kStepLimit) {}

    std::size_t batch_samples() const override { return 65536; }

    void evaluate(const integrate::SampleBatch& samples, const integrate::SampleOut& out,
                  integrate::Counters& counters) const override {
        thread_local integrate::SurfaceWork work;
        integrate::SurfaceChunk& chunk = work.chunk;
        follow_beams(setup_, samples, work.batch, counters);
        while (next_chunk(work.batch, chunk)) {
            place_rays(setup_, samples, chunk, counters);
            cull_rays(setup_, work.batch, chunk, counters);
            trace_rays(setup_, chunk, counters);
            resolve_hits(setup_, chunk, counters);
            clear_shadows(chunk);
            illuminate(setup_, chunk, counters);
            shade(setup_, chunk, counters);
            put_back(chunk, out.radiance, counters);
        }
    }

  private:
    integrate::SurfaceSetup setup_;
};

struct Side {
    std::unique_ptr<integrate::ImageFunction> image;
    estimate::Estimator estimator;

    explicit Side(const scene::Scene& scene, std::unique_ptr<integrate::ImageFunction> other = nullptr)
        : image(other ? std::move(other) : integrate::make_image(scene)),
          estimator(estimate::estimator_settings(scene)) {}

    render::RenderResult render() const {
        render::RenderOptions options;
        options.threads = 1;
        return render::render(*image, estimator, {0, 0, kWidth, kHeight}, options);
    }
};

// Same work must mean same counts: else the pair does not compare what it says.
bool same_counts(const Side& first, const Side& second) {
    const integrate::Counters a = first.render().counters, b = second.render().counters;
    return a.hits == b.hits && a.noise_evaluations == b.noise_evaluations;
}

void compare(benchmark::State& state, const Side& first, const Side& second, bool is_same_work) {
    if (is_same_work && !same_counts(first, second)) return state.SkipWithError("the counts differ");
    const double rays = static_cast<double>(first.render().counters.rays);
    run_pair(
        state, rays, [&] { benchmark::DoNotOptimize(first.render()); },
        [&] { benchmark::DoNotOptimize(second.render()); });
}

void bare(benchmark::State& state, const char* name) {
    const scene::Scene scene = plain(name);
    compare(state, Side(scene, std::make_unique<BareImage>(scene)), Side(scene), true);
}

using Change = std::function<void(scene::Scene&)>;

void add_pair(
    const std::string& name, const char* scene_name, bool is_same_work, const Change& change,
    const Change& prepare = [](scene::Scene&) {}) {
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        scene::Scene without = plain(scene_name);
        prepare(without);
        scene::Scene with = without;
        change(with);
        compare(state, Side(without), Side(with), is_same_work);
    })->Unit(benchmark::kMillisecond);
}

// A terrain's noise in three dimensions rather than two, by the evaluation: the surfaces differ.
void dimensions(benchmark::State& state) {
    const scene::Scene flat = plain("terrain");
    scene::Scene space = flat;
    space.surface.kind = solid::kKind<solid::DisplacedPlane>;
    const Side first(flat), second(space);
    const double a = static_cast<double>(first.render().counters.noise_evaluations);
    const double b = static_cast<double>(second.render().counters.noise_evaluations);
    std::vector<double> ratios;
    for (auto _ : state) {
        const double first_s = timed([&] { benchmark::DoNotOptimize(first.render()); });
        ratios.push_back(timed([&] { benchmark::DoNotOptimize(second.render()); }) / b / (first_s / a));
    }
    state.counters["ratio"] = tools::report::spread_of(ratios).median;
}

}  // namespace

int main(int argc, char** argv) {
    for (const char* name : {"terrain", "hyperterrain"}) {
        benchmark::RegisterBenchmark((std::string("bare/") + name).c_str(), [name](benchmark::State& state) {
            bare(state, name);
        })->Unit(benchmark::kMillisecond);
    }
    add_pair("unused/open_shutter", "terrain", true, [](scene::Scene& scene) { scene.shutter.open_s = 0.02; });
    add_pair("unused/resting_camera_keys", "terrain", true, [](scene::Scene& scene) {
        scene.camera.keys = {{.time_s = 0.0}, {.time_s = 1.0, .position = glm::dvec3(9.0, 9.0, 9.0)}};
    });
    add_pair("unused/spin_at_an_instant", "hyperterrain", true,
             [](scene::Scene& scene) { scene.surface.spin_deg_per_s = 5.0; });
    add_pair("unused/drift_along_y", "terrain", true, [](scene::Scene& scene) { scene.surface.drift.y = 1.0; });
    add_pair("unused/shadows_of_a_black_sun", "terrain", true, [](scene::Scene& scene) {
        scene.sun.shadows = true;
        scene.sun.colour = glm::dvec3(0.0);
    });
    add_pair(
        "unused/octaves_below_the_last_bit", "hyperterrain", true,
        [](scene::Scene& scene) { scene.surface.octaves = 32; },
        [](scene::Scene& scene) { scene.surface.gain = 1e-3; });
    add_pair("used/drift", "hyperterrain", true, [](scene::Scene& scene) { scene.surface.drift.x = 1.0; });
    add_pair("used/haze", "terrain", true, [](scene::Scene& scene) { scene.sky.haze_distance = 100.0; });
    add_pair("used/shadows", "terrain", false, [](scene::Scene& scene) { scene.sun.shadows = true; });
    add_pair("used/time_samples", "hyperterrain", false, [](scene::Scene& scene) {
        scene.shutter.open_s = 0.02;
        scene.surface.spin_deg_per_s = 5.0;
    });
    benchmark::RegisterBenchmark("used/third_dimension", dimensions)->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
