#pragma once

namespace strata::render {

// CPU time of the calling thread.
double thread_cpu_seconds();

}  // namespace strata::render
