#include "src/image/scratch_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>

namespace strata::image {

namespace {

using Slot = std::atomic<const char*>;
static_assert(Slot::is_always_lock_free && std::atomic<bool>::is_always_lock_free, "a signal handler uses them");

std::array<Slot, 512> slots{};
std::atomic<bool> is_ending{false};

[[noreturn]] void await_the_end() {
    for (;;) ::pause();
}

// Whoever takes the path out of its slot may use it: its owner, or the handler, never both.
bool take(Slot& slot, const char* path) { return slot.compare_exchange_strong(path, nullptr); }

}  // namespace

void remember_scratch_file(const char* path) noexcept {
    for (Slot& slot : slots) {
        const char* free = nullptr;
        if (!slot.compare_exchange_strong(free, path)) continue;
        if (!is_ending.load()) return;
        if (take(slot, path)) ::unlink(path);
        await_the_end();
    }
}

void forget_scratch_file(const char* path) noexcept {
    for (Slot& slot : slots) {
        if (slot.load() == path && take(slot, path)) return;
    }
    // A handler that has taken the path reads it until the program ends.
    if (is_ending.load()) await_the_end();
}

void remove_scratch_files() noexcept {
    const int interrupted_errno = errno;
    is_ending.store(true);
    for (auto slot = slots.rbegin(); slot != slots.rend(); ++slot) {
        const char* path = slot->exchange(nullptr);
        if (path != nullptr && ::unlink(path) != 0) ::rmdir(path);
    }
    errno = interrupted_errno;
}

}  // namespace strata::image
