#include "tools/stability/case.h"
namespace strata::tools::stability {
void add_tracing_cases(std::vector<Case>&) {}
}  // namespace strata::tools::stability
