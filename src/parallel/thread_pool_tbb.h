// TBB behind a plain function call. thread_pool_tbb.cpp is the only file that includes TBB and, under ThreadSanitizer,
// the only one built without it: TBB's templates read and write the task objects whose hand-over its library orders
// unseen.
#pragma once

#include <memory>

namespace strata::parallel {

class TbbArena {
  public:
    // Up to `threads` threads, the caller among them, even where the machine has fewer.
    explicit TbbArena(int threads);
    ~TbbArena();

    // Calls work(context, worker) for every worker of [0,workers), at the same time where threads are free.
    void run(int workers, void (*work)(void* context, int worker), void* context);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strata::parallel
