// This run beside an earlier one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/results.h"

namespace strata::tools::bench {

// Of the JSON's layout and of what its names mean: files of another format are refused.
inline constexpr int kFormat = 1;

// A case of the earlier run.
struct EarlierCase {
    std::string id, mark;
    double ns_a_ray_least = 0, ns_a_ray_median = 0;
    double evaluations_a_ray = 0;
};

struct EarlierRun {
    std::filesystem::path file;
    std::string version, processor, simd_target;
    std::vector<EarlierCase> cases;
};

// Reads a file that json_report() wrote. Throws UsageError, naming the file and what is wrong: not there, no JSON, no
// benchmark, another format, a case without its numbers.
EarlierRun read_earlier(const std::filesystem::path& file);

// Before anything is measured: throws UsageError if a case of both is not the same scene and pixels, or there is none
// in both.
void check_comparable(const EarlierRun& earlier, const Plan& plan);

// Now over then: below 1 is better now.
struct Comparison {
    std::string id;
    double time_ratio = 0;         // of the least ns a ray
    double median_ratio = 0;       // of the medians
    double evaluations_ratio = 0;  // 1 where neither evaluates noise
};

// The cases of both runs, in this one's order.
std::vector<Comparison> compare(const EarlierRun& earlier, const std::vector<Measurement>& now);

// Geometric mean of the time ratios of the fast tracer's cases; and of the reference tracer's, which tells how the
// machine itself has changed. Empty where there is none.
struct Overall {
    std::optional<double> fast, reference;
};
Overall overall(const std::vector<Comparison>& comparisons);

}  // namespace strata::tools::bench
