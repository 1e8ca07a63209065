// A race on purpose: two tasks write one plain int through the pool. Under ThreadSanitizer this program must be caught,
// or the pool's annotations hide what they should not.
#include <atomic>
#include <cstdio>

#include "src/parallel/thread_pool.h"

int main() {
    strata::parallel::ThreadPool pool(2);
    int raced = 0;
    std::atomic<int> arrived{0};
    pool.run(2, [&](int, std::int64_t) {
        // Relaxed: both tasks are on their way without any order between them.
        arrived.fetch_add(1, std::memory_order_relaxed);
        while (arrived.load(std::memory_order_relaxed) < 2) {
        }
        for (int i = 0; i < 1000; ++i) ++raced;
    });
    std::printf("%d\n", raced);
}
