// The one place through which work reaches TBB. Debian's TBB is built without ThreadSanitizer, which therefore sees
// neither a task's start nor its join as an ordering; the pool states both by an atomic of its own, so that no
// suppression is needed and a race in the work itself is still found.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace strata::parallel {

class ThreadPool {
  public:
    // threads: any number; 0 takes as many as this process may use (available_processors()). Fewer where the system
    // starts no more.
    explicit ThreadPool(int threads);
    ~ThreadPool();

    int threads() const { return threads_; }

    // Calls body(worker, index) once for every index of [0,count), handed out in ascending order, on up to threads()
    // workers, and returns when all are done. A worker, a number of [0,threads()), is never in two calls at once: state
    // kept per worker needs no lock. All that happened before run() happens before every call, and every call before
    // its return. An exception from a body is rethrown here, after the calls in flight.
    using Body = std::function<void(int worker, std::int64_t index)>;
    void run(std::int64_t count, const Body& body);

  private:
    struct Arena;

    int threads_;
    std::unique_ptr<Arena> arena_;
};

}  // namespace strata::parallel
