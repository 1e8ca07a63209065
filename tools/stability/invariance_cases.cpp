#include "tools/stability/case.h"
namespace strata::tools::stability {
void add_invariance_cases(std::vector<Case>&) {}
}  // namespace strata::tools::stability
