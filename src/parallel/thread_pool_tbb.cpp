#include "src/parallel/thread_pool_tbb.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace strata::parallel {

// TBB starts no more threads than the machine has unless its global limit is raised.
struct TbbArena::State {
    explicit State(int threads)
        : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(std::max(threads, 1))),
          arena(threads) {}

    tbb::global_control limit;
    tbb::task_arena arena;
};

TbbArena::TbbArena(int threads) : state_(std::make_unique<State>(threads)) {}

TbbArena::~TbbArena() = default;

void TbbArena::run(int workers, void (*work)(void* context, int worker), void* context) {
    state_->arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<int>(0, workers, 1),
            [&](const tbb::blocked_range<int>& range) {
                for (int worker = range.begin(); worker < range.end(); ++worker) work(context, worker);
            },
            tbb::simple_partitioner());
    });
}

}  // namespace strata::parallel
