#include "src/render/cancel.h"

#include <csignal>

namespace strata::render {

namespace {

std::atomic<CancelToken*> signalled_token{nullptr};
std::atomic<int> first_signal{0};
static_assert(std::atomic<CancelToken*>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

// Touches lock-free atomics only: safe in a handler.
void handle_signal(int signal) {
    int none = 0;
    first_signal.compare_exchange_strong(none, signal);
    if (CancelToken* token = signalled_token.load()) token->request();
}

}  // namespace

void cancel_on_signals(CancelToken& token) {
    first_signal.store(0);
    signalled_token.store(&token);
    struct sigaction action = {};
    action.sa_handler = handle_signal;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

int cancelling_signal() { return first_signal.load(); }

}  // namespace strata::render
