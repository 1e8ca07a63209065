// How far a render is. Rendering counts and calls back; it prints nothing (tools/cli/progress_printer.h does).
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>

namespace strata::parallel {

struct Progress {
    double fraction = 0;  // of the work, [0,1]
    std::uint64_t rays = 0;
    double seconds = 0;  // since the start

    double rays_per_second() const { return seconds > 0 ? static_cast<double>(rays) / seconds : 0; }
    double predicted_seconds() const { return fraction > 0 ? seconds / fraction : 0; }  // of the whole; 0: unknown
};

using ProgressCallback = std::function<void(const Progress&)>;

// Counts finished work from any thread and calls back at most ten times a second, never twice at once.
class ProgressMeter {
  public:
    ProgressMeter(std::int64_t total_work, ProgressCallback callback);

    // To be called a tile at a time, not a sample.
    void add(std::int64_t work, std::int64_t rays);

    // Work that needs not be done after all. Before any is.
    void leave_out(std::int64_t work) { total_work_ -= work; }

    double seconds() const;

  private:
    std::int64_t total_work_;
    ProgressCallback callback_;
    std::chrono::steady_clock::time_point start_;
    std::atomic<std::int64_t> work_{0};
    std::atomic<std::uint64_t> rays_{0};
    std::mutex calling_;
    double next_call_s_ = 0;  // guarded by calling_
};

}  // namespace strata::parallel
