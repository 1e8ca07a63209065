// Runs the cases: those of the machine's best SIMD target together on several threads, then each other target's.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/stability/case.h"

namespace strata::tools::stability {

// In the order of the table.
std::vector<std::string> groups();

// Every case of the groups named; all of them for an empty list.
std::vector<Case> cases_of(const std::vector<std::string>& chosen);

// done, total, the case that begins next. From any thread, one call at a time.
using OnCase = std::function<void(std::size_t done, std::size_t total, const Case& next)>;

// The rows in the order of the cases, whatever the threads (0: as many as the machine has). When cancelled, those of
// the cases that were finished.
std::vector<Row> run_cases(const std::vector<Case>& cases, const Settings& settings, int threads,
                           const OnCase& on_case);

}  // namespace strata::tools::stability
