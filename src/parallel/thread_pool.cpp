#include "src/parallel/thread_pool.h"

#include <algorithm>
#include <atomic>

#include "src/parallel/processors.h"
#include "src/parallel/startable_threads.h"
#include "src/parallel/thread_pool_tbb.h"

namespace strata::parallel {

struct ThreadPool::Arena {
    explicit Arena(int threads) : tbb(threads) {}
    TbbArena tbb;
};

namespace {

struct Job {
    const ThreadPool::Body* body;
    std::int64_t count;
    std::atomic<std::int64_t> next{0};
    std::atomic<int> order{0};  // released before the start and at every worker's end, acquired at the other side
    std::atomic<bool> failed{false};
};

// Marks a worker's end also when a body throws.
struct WorkerScope {
    explicit WorkerScope(Job& job) : job_(job) { job_.order.load(std::memory_order_acquire); }
    ~WorkerScope() { job_.order.fetch_add(1, std::memory_order_acq_rel); }
    WorkerScope(const WorkerScope&) = delete;
    WorkerScope& operator=(const WorkerScope&) = delete;

  private:
    Job& job_;
};

void work(void* job_pointer, int worker) {
    Job& job = *static_cast<Job*>(job_pointer);
    const WorkerScope scope(job);
    try {
        for (;;) {
            const std::int64_t index = job.next.fetch_add(1, std::memory_order_relaxed);
            if (index >= job.count || job.failed.load(std::memory_order_relaxed)) return;
            (*job.body)(worker, index);
        }
    } catch (...) {
        job.failed.store(true, std::memory_order_relaxed);
        throw;
    }
}

}  // namespace

ThreadPool::ThreadPool(int threads)
    : threads_(1 + startable_threads((threads > 0 ? threads : available_processors()) - 1)),
      arena_(std::make_unique<Arena>(threads_)) {}

ThreadPool::~ThreadPool() = default;

void ThreadPool::run(std::int64_t count, const Body& body) {
    if (count <= 0) return;
    Job job{&body, count};
    job.order.store(1, std::memory_order_release);
    const int workers = static_cast<int>(std::min<std::int64_t>(threads_, count));
    struct Join {
        std::atomic<int>& order;
        ~Join() { order.load(std::memory_order_acquire); }
    } join{job.order};
    arena_->tbb.run(workers, &work, &job);
}

}  // namespace strata::parallel
