#include "tools/converge/budget.h"

#include <algorithm>
#include <cmath>

namespace strata::tools::converge {

std::optional<BudgetPlan> plan_budget(std::vector<int> Ns, int wanted_seeds, double available_s,
                                      const std::function<double(int)>& cost_s,
                                      const std::function<double(int)>& fixed_s) {
    for (; !Ns.empty(); Ns.pop_back()) {
        double round_s = 0;
        for (const int N : Ns) round_s += cost_s(N);
        const double fixed = fixed_s(Ns.back());
        const double fitting = std::floor((available_s - fixed) / round_s);
        const int seeds = static_cast<int>(std::clamp(fitting, 0.0, static_cast<double>(wanted_seeds)));
        const int least = std::min(wanted_seeds, Ns.size() == 1 ? 2 : kLeastSeeds);
        if (seeds >= least) return BudgetPlan{Ns, seeds, fixed + seeds * round_s};
    }
    return std::nullopt;
}

}  // namespace strata::tools::converge
