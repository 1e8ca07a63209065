// Noise throughput a SIMD target: the counter ns_per_point is the cost of one point, of a batch of 4096 within a few
// hundred cells of the base cell. `reference` is the scalar double path.
#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "noise/noise.h"
#include "noise/reference.h"
#include "noise/simd_target.h"

namespace {

using namespace strata::noise;

constexpr std::size_t kCount = 4096;

template <std::size_t D>
struct Batch {
    LatticeKey key = lattice_key(1, 0);
    std::array<std::vector<float>, D> offset, gradient;
    std::array<std::vector<float>, D*(D + 1) / 2> hessian;
    std::vector<float> value = std::vector<float>(kCount);
    Points<D> points;
    GradientSpans<D> gradient_spans;
    HessianSpans<D> hessian_spans;

    Batch() {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(-256.0f, 256.0f);
        for (std::size_t a = 0; a < D; ++a) {
            for (std::size_t i = 0; i < kCount; ++i) offset[a].push_back(uniform(random));
            gradient[a].resize(kCount);
            points.offset[a] = offset[a];
            gradient_spans.axis[a] = gradient[a];
        }
        for (std::size_t e = 0; e < hessian.size(); ++e) {
            hessian[e].resize(kCount);
            hessian_spans.entry[e] = hessian[e];
        }
    }
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;
};

// Runs `points` points an iteration and counts them; CPU time, as the benchmark's own figures.
template <class Run>
void measure(benchmark::State& state, std::size_t points, const Run& run) {
    const std::clock_t start = std::clock();
    for (auto _ : state) {
        run();
        benchmark::ClobberMemory();
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double total = static_cast<double>(state.iterations()) * static_cast<double>(points);
    state.SetItemsProcessed(static_cast<std::int64_t>(total));
    state.counters["ns_per_point"] = 1e9 * seconds / total;
}

template <std::size_t D, class Run>
void bench(const std::string& target, const std::string& what, Run run) {
    const std::string name = "noise/" + target + "/" + what + "/" + std::to_string(D) + "d";
    benchmark::RegisterBenchmark(name.c_str(), [target, run](benchmark::State& state) {
        if (!pin_simd_target(target)) return state.SkipWithError("no such SIMD target");
        Batch<D> batch;
        measure(state, kCount, [&] { run(batch); });
    });
}

template <std::size_t D>
void register_target(const std::string& target) {
    bench<D>(target, "value", [](Batch<D>& b) { noise_value(b.key, b.points, b.value); });
    bench<D>(target, "gradient", [](Batch<D>& b) { noise_gradient(b.key, b.points, b.value, b.gradient_spans); });
    bench<D>(target, "hessian",
             [](Batch<D>& b) { noise_hessian(b.key, b.points, b.value, b.gradient_spans, b.hessian_spans); });
    bench<D>(target, "fbm8", [octaves = make_octaves({.octaves = 8})](Batch<D>& b) {
        fbm_value(octaves, std::array<double, D>{}, b.points.offset, b.value);
    });
}

template <int D>
void bench_reference(benchmark::State& state) {
    const Batch<D> batch;
    std::vector<Point<D>> positions(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        for (std::size_t a = 0; a < D; ++a) positions[i][a] = static_cast<double>(batch.offset[a][i]);
    }
    measure(state, kCount, [&] {
        for (const Point<D>& p : positions) {
            benchmark::DoNotOptimize(reference_value<D>(batch.key, split_position<D>(p)));
        }
    });
}

void register_all() {
    for (const std::string& target : simd_targets()) {
        register_target<2>(target);
        register_target<3>(target);
    }
    benchmark::RegisterBenchmark("noise/reference/value/2d", bench_reference<2>);
    benchmark::RegisterBenchmark("noise/reference/value/3d", bench_reference<3>);
}

}  // namespace

int main(int argc, char** argv) {
    register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
