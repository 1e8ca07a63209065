// B-spline inversion: the bulk table per SIMD target, the exact inverse, and the paper's recursive Newton iteration.
// Items are coordinates; y is uniform in [0,1].
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "src/filter/bspline.h"
#include "src/filter/bspline_paper.h"
#include "src/filter/bspline_table.h"

namespace {

using namespace strata::filter;

std::vector<double> uniform_values(std::size_t count) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> values(count);
    for (double& value : values) value = uniform(random);
    return values;
}

void bench_bulk(benchmark::State& state, std::int64_t target, int m) {
    hwy::SetSupportedTargetsForTest(target);
    const BsplineTable table(m);
    std::vector<float> q;
    for (double y : uniform_values(4096)) q.push_back(static_cast<float>(y <= 0.5 ? -y : 1 - y));
    std::vector<float> x(q.size());
    for (auto _ : state) {
        table.centred(q, x);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(q.size()));
    hwy::SetSupportedTargetsForTest(0);
}

template <class Invert>
void bench_scalar(benchmark::State& state, int m, Invert invert) {
    const std::vector<double> ys = uniform_values(4096);
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(invert(m, ys[i++ % ys.size()]));
    state.SetItemsProcessed(state.iterations());
}

void bench_build(benchmark::State& state, int m) {
    for (auto _ : state) benchmark::DoNotOptimize(BsplineTable(m));
}

const bool kRegistered = [] {
    for (const std::int64_t target : {HWY_SCALAR, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
        if ((hwy::SupportedTargets() & target) == 0 && target != HWY_SCALAR) continue;
        for (int m : {4, 15}) {
            const std::string name = std::string("bspline/bulk/") + hwy::TargetName(target) + "/m:" + std::to_string(m);
            benchmark::RegisterBenchmark(name.c_str(), bench_bulk, target, m);
        }
    }
    for (int m : {4, 15, 32, 100}) {
        const std::string order = "/m:" + std::to_string(m);
        benchmark::RegisterBenchmark(("bspline/exact" + order).c_str(),
                                     [m](benchmark::State& state) { bench_scalar(state, m, bspline_inverse_cdf); });
        benchmark::RegisterBenchmark(("bspline/build" + order).c_str(), bench_build, m);
    }
    for (int m : {4, 8}) {
        const std::string name = "bspline/paper/m:" + std::to_string(m);
        benchmark::RegisterBenchmark(name.c_str(), [m](benchmark::State& state) {
            bench_scalar(state, m, [](int order, double y) { return paper::inverse_cdf(order, y).x; });
        });
    }
    return true;
}();

}  // namespace

BENCHMARK_MAIN();
