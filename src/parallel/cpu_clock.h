#pragma once

namespace strata::parallel {

// CPU time of the calling thread.
double thread_cpu_seconds();

}  // namespace strata::parallel
