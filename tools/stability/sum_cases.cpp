#include "tools/stability/case.h"
namespace strata::tools::stability {
void add_sum_cases(std::vector<Case>&) {}
}  // namespace strata::tools::stability
