// How much of what was asked for fits into a time.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace strata::tools::converge {

struct BudgetPlan {
    std::vector<int> Ns;
    int seeds = 0;
    double predicted_s = 0;
};

// cost_s(N) is the predicted time of one seed of everything at N, fixed_s(N) what is spent once when N is the largest.
// Drops the largest N until the rest fits with least_seeds or the wanted number if that is less, then takes as many
// seeds as fit, up to the wanted. Nothing where not even the smallest N fits with two seeds (one, if one is wanted).
std::optional<BudgetPlan> plan_budget(std::vector<int> Ns, int wanted_seeds, double available_s,
                                      const std::function<double(int)>& cost_s,
                                      const std::function<double(int)>& fixed_s);

inline constexpr int kLeastSeeds = 4;  // for a confidence interval worth its name

}  // namespace strata::tools::converge
