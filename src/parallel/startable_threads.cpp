#include "src/parallel/startable_threads.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

namespace strata::parallel {
namespace {

// Of this process; 0 where /proc is not mounted.
std::ptrdiff_t count_threads() {
    std::error_code error;
    const std::filesystem::directory_iterator tasks("/proc/self/task", error);
    return error ? 0 : std::distance(begin(tasks), end(tasks));
}

// A thread that was joined may still count against the limit: the kernel lowers the count afterwards, but before it
// takes the thread out of /proc/self/task.
void await_release(std::ptrdiff_t before) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
    while (count_threads() > before && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
}

}  // namespace

int startable_threads(int wanted) {
    const std::ptrdiff_t before = count_threads();
    std::latch counted(1);
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(std::max(wanted, 0)));
    try {
        while (static_cast<int>(threads.size()) < wanted) threads.emplace_back([&counted] { counted.wait(); });
    } catch (const std::system_error&) {
        // The limit is reached: those that started are the answer.
    }
    counted.count_down();
    for (std::thread& thread : threads) thread.join();
    if (static_cast<int>(threads.size()) < wanted) await_release(before);
    return static_cast<int>(threads.size());
}

}  // namespace strata::parallel
