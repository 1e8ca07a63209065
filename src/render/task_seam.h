// The one place through which work reaches several threads.
#pragma once

#include <cstdint>
#include <functional>

#include "src/render/crew.h"

namespace strata::render {

class TaskSeam {
  public:
    // threads: any number; 0 takes as many as this process may use (available_processors()). Fewer where the system
    // gives no more.
    explicit TaskSeam(int threads);

    int threads() const { return crew_.size(); }

    // Calls body(worker, index) once for every index of [0,count), handed out in ascending order, on up to threads()
    // workers, and returns when all are done. A worker, a number of [0,threads()), is never in two calls at once: state
    // kept per worker needs no lock. All that happened before run() happens before every call, and every call before
    // its return. An exception from a body is rethrown here, after the calls in flight.
    using Body = std::function<void(int worker, std::int64_t index)>;
    void run(std::int64_t count, const Body& body);

  private:
    Crew crew_;
};

}  // namespace strata::render
