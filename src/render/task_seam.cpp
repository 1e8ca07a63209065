#include "src/render/task_seam.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#include "src/render/processors.h"

namespace strata::render {

namespace {

struct Job {
    const TaskSeam::Body& body;
    std::int64_t count;
    std::atomic<std::int64_t> next{0};
    std::atomic<bool> failed{false};
    std::mutex mutex{};
    std::exception_ptr first_failure{};
};

void work(Job& job, int worker) {
    try {
        for (;;) {
            const std::int64_t index = job.next.fetch_add(1, std::memory_order_relaxed);
            if (index >= job.count || job.failed.load(std::memory_order_relaxed)) return;
            job.body(worker, index);
        }
    } catch (...) {
        job.failed.store(true, std::memory_order_relaxed);
        const std::lock_guard lock(job.mutex);
        if (!job.first_failure) job.first_failure = std::current_exception();
    }
}

}  // namespace

TaskSeam::TaskSeam(int threads) : crew_(threads > 0 ? threads : available_processors()) {}

void TaskSeam::run(std::int64_t count, const Body& body) {
    if (count <= 0) return;
    Job job{body, count};
    crew_.run(static_cast<int>(std::min<std::int64_t>(threads(), count)), [&](int worker) { work(job, worker); });
    if (job.first_failure) std::rethrow_exception(job.first_failure);
}

}  // namespace strata::render
