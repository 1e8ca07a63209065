// Plain, unsynchronised state on purpose: under ThreadSanitizer this test shows that the pool orders it.
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "src/parallel/processors.h"
#include "src/parallel/thread_pool.h"

using strata::parallel::ThreadPool;

TEST_CASE("every index is visited once, workers never overlap, and results are seen after the join") {
    for (const int threads : {1, 2, 3, 7}) {
        ThreadPool pool(threads);
        CHECK(pool.threads() == threads);
        for (const std::int64_t count : {std::int64_t{0}, std::int64_t{1}, std::int64_t{5}, std::int64_t{10000}}) {
            std::vector<int> input(static_cast<std::size_t>(count));
            std::iota(input.begin(), input.end(), 3);
            std::vector<int> output(input.size(), 0);
            std::vector<std::int64_t> per_worker(static_cast<std::size_t>(threads), 0);
            for (int round = 0; round < 20; ++round) {
                pool.run(count, [&](int worker, std::int64_t index) {
                    output[static_cast<std::size_t>(index)] += input[static_cast<std::size_t>(index)];
                    ++per_worker[static_cast<std::size_t>(worker)];
                });
                for (int& value : input) ++value;
            }
            for (std::size_t i = 0; i < output.size(); ++i) {
                REQUIRE(output[i] == 20 * (static_cast<int>(i) + 3) + 190);
            }
            CHECK(std::accumulate(per_worker.begin(), per_worker.end(), std::int64_t{0}) == 20 * count);
        }
    }
}

TEST_CASE("more threads than the machine has work at the same time") {
    const int threads = static_cast<int>(std::thread::hardware_concurrency()) + 3;
    ThreadPool pool(threads);
    std::atomic<int> arrived{0};
    // Each call waits for all: it returns only if every thread has one.
    pool.run(threads, [&](int, std::int64_t) {
        ++arrived;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (arrived.load() < threads && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    });
    CHECK(arrived.load() == threads);
    CHECK(ThreadPool(0).threads() == strata::parallel::available_processors());
}

TEST_CASE("an exception in one call reaches the caller, and the pool is usable afterwards") {
    ThreadPool pool(3);
    CHECK_THROWS_AS(pool.run(1000,
                             [](int, std::int64_t index) {
                                 if (index == 17) throw std::runtime_error("planted");
                             }),
                    std::runtime_error);
    std::atomic<int> calls{0};
    pool.run(100, [&](int, std::int64_t) { ++calls; });
    CHECK(calls == 100);
}
