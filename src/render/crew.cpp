#include "src/render/crew.h"

#include <algorithm>
#include <system_error>

namespace strata::render {

Crew::Crew(int size) {
    try {
        threads_.reserve(static_cast<std::size_t>(std::max(size - 1, 0)));
        for (int member = 1; member < size; ++member) threads_.emplace_back([this, member] { stand_by(member); });
    } catch (const std::system_error&) {
        // No more threads to be had: fewer make the same picture.
    } catch (...) {
        dismiss();
        throw;
    }
}

Crew::~Crew() { dismiss(); }

void Crew::dismiss() {
    {
        const std::lock_guard lock(mutex_);
        dismissed_ = true;
    }
    called_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Crew::run(int members, const std::function<void(int)>& work) {
    const int called = std::min(members, size());
    if (called > 1) {
        {
            const std::lock_guard lock(mutex_);
            work_ = &work;
            members_ = called;
            at_work_ = called - 1;
            ++call_;
        }
        called_.notify_all();
    }
    if (called > 0) work(0);
    if (called <= 1) return;
    std::unique_lock lock(mutex_);
    finished_.wait(lock, [this] { return at_work_ == 0; });
}

void Crew::stand_by(int member) {
    std::uint64_t seen = 0;
    for (;;) {
        const std::function<void(int)>* work = nullptr;
        {
            std::unique_lock lock(mutex_);
            called_.wait(lock, [&] { return dismissed_ || (call_ != seen && member < members_); });
            if (dismissed_) return;
            seen = call_;
            work = work_;
        }
        (*work)(member);
        const std::lock_guard lock(mutex_);
        if (--at_work_ == 0) finished_.notify_one();
    }
}

}  // namespace strata::render
