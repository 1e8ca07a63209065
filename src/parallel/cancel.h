// Stopping a render early: by the program, or by SIGINT, SIGTERM and SIGHUP.
#pragma once

#include <atomic>

namespace strata::parallel {

class CancelToken {
  public:
    void request() { requested_.store(true, std::memory_order_relaxed); }
    bool requested() const { return requested_.load(std::memory_order_relaxed); }

  private:
    static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");
    std::atomic<bool> requested_{false};
};

// What handlers of signals call; async-signal-safe. `is_last`: the program ends when it returns.
using SignalHook = void (*)(int signal, bool is_last);

// From now on SIGQUIT and SIGXCPU call `hook` before they end the program, and so do the signals that the functions
// below handle. Signals that are ignored stay ignored: nohup and shells' background jobs say so.
void call_on_signals(SignalHook hook);

// From now on SIGINT, SIGTERM and SIGHUP call the hook and end the program.
void end_on_signals();

// From now on SIGINT, SIGTERM and SIGHUP request cancellation of `token`, which must outlive the program's renders; a
// second signal of the same kind ends the program, so that one that does not come to an end can be ended. What comes
// within a tenth of a second of the first is part of it: `timeout` sends its signal to the program and to its group.
void cancel_on_signals(CancelToken& token);

// The signal that cancelled, or 0. A program so ended exits with 128 plus this number.
int cancelling_signal();

}  // namespace strata::parallel
