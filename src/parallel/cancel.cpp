#include "src/parallel/cancel.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace strata::parallel {

namespace {

constexpr std::array kCancelling{SIGINT, SIGTERM, SIGHUP};
constexpr std::array kEnding{SIGQUIT, SIGXCPU};
constexpr std::int64_t kOneSignal_ns = 100'000'000;

std::atomic<CancelToken*> signalled_token{nullptr};
std::atomic<SignalHook> signal_hook{nullptr};
std::atomic<int> first_signal{0};
std::array<std::atomic<std::int64_t>, NSIG> first_time_ns{};  // of each signal; 0: not yet
static_assert(std::atomic<CancelToken*>::is_always_lock_free && std::atomic<SignalHook>::is_always_lock_free &&
              std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t now_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

void call_hook(int signal, bool is_last) {
    if (const SignalHook hook = signal_hook.load()) hook(signal, is_last);
}

// All handlers touch lock-free atomics and call async-signal-safe functions only.

// As the signal would have ended the program by itself, a core file included: it is blocked until the handler returns.
void end(int signal) {
    call_hook(signal, true);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void cancel_or_end(int signal) {
    const int interrupted_errno = errno;
    CancelToken* token = signalled_token.load();
    const std::int64_t now = now_ns();
    std::int64_t first = 0;
    const bool is_first = first_time_ns[static_cast<std::size_t>(signal)].compare_exchange_strong(first, now);
    if (!is_first && now - first >= kOneSignal_ns) {
        end(signal);
    } else if (is_first) {
        int none = 0;
        first_signal.compare_exchange_strong(none, signal);
        token->request();
        call_hook(signal, false);
    }
    errno = interrupted_errno;
}

void handle_unless_ignored(int signal, void (*handler)(int)) {
    struct sigaction action = {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) return;
    action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigfillset(&action.sa_mask);  // one handler at a time
    sigaction(signal, &action, nullptr);
}

}  // namespace

void call_on_signals(SignalHook hook) {
    signal_hook.store(hook);
    for (const int signal : kEnding) handle_unless_ignored(signal, end);
}

void end_on_signals() {
    for (const int signal : kCancelling) handle_unless_ignored(signal, end);
}

void cancel_on_signals(CancelToken& token) {
    first_signal.store(0);
    for (auto& time : first_time_ns) time.store(0);
    signalled_token.store(&token);
    for (const int signal : kCancelling) handle_unless_ignored(signal, cancel_or_end);
}

int cancelling_signal() { return first_signal.load(); }

}  // namespace strata::parallel
