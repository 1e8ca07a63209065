#include "src/parallel/progress.h"

#include <utility>

namespace strata::parallel {

namespace {

constexpr double kCallInterval_s = 0.1;

}  // namespace

ProgressMeter::ProgressMeter(std::int64_t total_work, ProgressCallback callback)
    : total_work_(total_work), callback_(std::move(callback)), start_(std::chrono::steady_clock::now()) {}

double ProgressMeter::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressMeter::add(std::int64_t work, std::int64_t rays) {
    const std::uint64_t added = static_cast<std::uint64_t>(rays);
    const std::uint64_t total_rays = rays_.fetch_add(added, std::memory_order_relaxed) + added;
    const std::int64_t done = work_.fetch_add(work, std::memory_order_relaxed) + work;
    if (!callback_) return;
    const std::unique_lock lock(calling_, std::try_to_lock);
    if (!lock) return;
    const double now_s = seconds();
    if (now_s < next_call_s_) return;
    next_call_s_ = now_s + kCallInterval_s;
    callback_({static_cast<double>(done) / static_cast<double>(total_work_), total_rays, now_s});
}

}  // namespace strata::parallel
