// What signals do to a program that listens to them. Each case forks; no thread is started here, for ThreadSanitizer
// follows no fork of a process with threads.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "src/parallel/cancel.h"

using namespace strata::parallel;

namespace {

// How a child process ends in which `body` runs.
int end_of(const std::function<void()>& body) {
    const pid_t child = fork();
    if (child == 0) {
        body();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

TEST_CASE("SIGINT, SIGTERM and SIGHUP cancel and are remembered; a second one ends the program") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const int end = end_of([&] {
            std::signal(signal, SIG_DFL);
            static CancelToken token;
            cancel_on_signals(token);
            if (cancelling_signal() != 0 || token.requested()) _exit(1);
            std::raise(signal);
            if (!token.requested() || cancelling_signal() != signal) _exit(2);
            std::raise(signal);  // at once: part of the first
            std::this_thread::sleep_for(std::chrono::milliseconds(150));
            std::raise(signal);
        });
        CHECK(end == 128 + signal);
    }
}

TEST_CASE("a signal that was ignored before stays ignored") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        const int end = end_of([&] {
            std::signal(signal, SIG_IGN);
            static CancelToken token;
            call_on_signals([](int, bool) { _exit(1); });
            cancel_on_signals(token);
            std::raise(signal);
            if (token.requested()) _exit(2);
        });
        CHECK(end == 0);
    }
}

TEST_CASE("the hook hears of the first signal and of the one that ends the program") {
    const int end = end_of([] {
        static CancelToken token;
        static int first_calls = 0;
        std::signal(SIGTERM, SIG_DFL);
        call_on_signals([](int, bool is_last) {
            if (is_last) _exit(first_calls == 1 ? 77 : 78);
            ++first_calls;
        });
        cancel_on_signals(token);
        std::raise(SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        std::raise(SIGTERM);
    });
    CHECK(end == 77);
}
