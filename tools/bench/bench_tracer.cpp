// The tracers on the benchmark scene `hyperterrain` at 480x270, a ray through each pixel's centre, on one thread. The
// reference tracer takes every 97th ray. Counters: ns_per_ray, evaluations_per_ray (noise evaluations), lanes_per_ray
// (evaluations with idle lanes counted), ns_per_evaluation.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <ctime>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "noise/simd_target.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "src/trace/camera.h"
#include "src/trace/fast_tracer.h"
#include "src/trace/placement.h"
#include "src/trace/reference_tracer.h"

namespace {

using namespace strata;

constexpr std::size_t kReferenceStride = 97;

scene::Scene benchmark_scene() {
    const char* const name = "hyperterrain";
    scene::Scene scene = scene::read_scene(scene::find_builtin(name)->text, name);
    scene.film.width = 480;
    scene.film.height = 270;
    return scene;
}

std::vector<trace::Ray> pixel_rays(const scene::Scene& scene, std::size_t stride) {
    const trace::Camera camera(scene.camera, scene.film);
    const trace::Placement placement(scene.surface);
    const glm::dmat3 orientation = placement.orientation(0.0);
    const auto width = static_cast<std::size_t>(scene.film.width), height = static_cast<std::size_t>(scene.film.height);
    std::vector<trace::Ray> rays;
    for (std::size_t i = 0; i < width * height; i += stride) {
        const std::size_t x = i % width, y = i / width;
        const trace::CameraRay seen = camera.ray(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
        rays.push_back(placement.to_local(orientation, {.origin = camera.position(),
                                                        .direction = seen.direction,
                                                        .limit = scene.camera.far,
                                                        .delta0 = 0.0,
                                                        .delta_slope = scene.sampling.tolerance * seen.pixel_angle}));
    }
    return rays;
}

template <class Trace>
void bench(benchmark::State& state, const std::vector<trace::Ray>& rays, const Trace& trace) {
    std::vector<trace::Hit> hits(rays.size());
    trace::TraceCounters counters;
    const std::clock_t start = std::clock();  // CPU time, as the benchmark's own figures
    for (auto _ : state) {
        trace(rays, hits, counters);
        benchmark::DoNotOptimize(hits.data());
    }
    const double nanoseconds = 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double traced = static_cast<double>(state.iterations()) * static_cast<double>(rays.size());
    const auto evaluations = static_cast<double>(counters.noise_evaluations);
    state.counters["ns_per_ray"] = nanoseconds / traced;
    state.counters["ns_per_evaluation"] = nanoseconds / evaluations;
    state.counters["evaluations_per_ray"] = evaluations / traced;
    state.counters["lanes_per_ray"] = static_cast<double>(counters.executed_lanes) / traced;
}

void bench_fast(benchmark::State& state, const std::string& target) {
    if (!noise::pin_simd_target(target)) return state.SkipWithError("no such SIMD target");
    const scene::Scene scene = benchmark_scene();
    const trace::Field field(scene.surface);
    const trace::FastTracer tracer(field);
    bench(state, pixel_rays(scene, 1),
          [&](const auto& rays, auto& hits, auto& counters) { tracer.trace(rays, hits, counters); });
}

void bench_reference(benchmark::State& state) {
    const scene::Scene scene = benchmark_scene();
    const trace::Field field(scene.surface);
    bench(state, pixel_rays(scene, kReferenceStride),
          [&](const auto& rays, auto& hits, auto& counters) { trace::trace_reference(field, rays, hits, counters); });
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::string& target : noise::simd_targets()) {
        benchmark::RegisterBenchmark(("tracer/fast/" + target).c_str(), [target](benchmark::State& state) {
            bench_fast(state, target);
        })->Unit(benchmark::kMillisecond);
    }
    benchmark::RegisterBenchmark("tracer/reference", bench_reference)->Unit(benchmark::kMillisecond);
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
