// Threads that stand by for work as long as the crew lives.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace strata::render {

class Crew {
  public:
    // The caller and up to size - 1 threads beside it. Where the system gives no more threads (a limit of processes),
    // those that it gave do the work.
    explicit Crew(int size);
    ~Crew();
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    // The caller counted.
    int size() const { return 1 + static_cast<int>(threads_.size()); }

    // Calls work(member) for every member of [0, min(members, size())) at the same time, member 0 on the caller, and
    // returns when all have returned. work must not throw.
    void run(int members, const std::function<void(int member)>& work);

  private:
    void stand_by(int member);
    void dismiss();

    std::vector<std::thread> threads_;
    std::mutex mutex_;
    std::condition_variable called_, finished_;
    const std::function<void(int)>* work_ = nullptr;
    std::uint64_t call_ = 0;  // counts the calls of run(), so that nobody works twice in one
    int members_ = 0;         // of the present call
    int at_work_ = 0;         // threads that have not returned from it yet
    bool dismissed_ = false;
};

}  // namespace strata::render
