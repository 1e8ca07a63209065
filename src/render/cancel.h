// Stopping a render early: by the program, or by SIGINT and SIGTERM.
#pragma once

#include <atomic>

namespace strata::render {

class CancelToken {
  public:
    void request() { requested_.store(true, std::memory_order_relaxed); }
    bool requested() const { return requested_.load(std::memory_order_relaxed); }

  private:
    static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
    std::atomic<bool> requested_{false};
};

// From now on SIGINT and SIGTERM request cancellation of `token`, which must outlive the program's renders; a second
// signal of the same kind has its usual effect, so that a program that does not come to an end can be ended.
void cancel_on_signals(CancelToken& token);

// The signal that cancelled, or 0. A program so ended exits with 128 plus this number.
int cancelling_signal();

}  // namespace strata::render
