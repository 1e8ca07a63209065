#include "tools/stability/case.h"
namespace strata::tools::stability {
void add_shadow_cases(std::vector<Case>&) {}
}  // namespace strata::tools::stability
