#include "tools/stability/run.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "noise/hash.h"
#include "noise/simd_target.h"
#include "src/parallel/thread_pool.h"

namespace strata::tools::stability {

namespace {

struct Group {
    const char* name;
    std::vector<void (*)(std::vector<Case>&)> add;
};

const std::vector<Group>& all_groups() {
    static const std::vector<Group> table = {{"bspline", {add_bspline_cases, add_paper_cases}},
                                             {"noise", {add_noise_cases, add_noise_sum_cases}},
                                             {"tracing", {add_random_scene_cases, add_tracing_cases}},
                                             {"shadow", {add_shadow_cases}},
                                             {"invariance", {add_invariance_cases}},
                                             {"sums", {add_sum_cases}},
                                             {"motion", {add_motion_cases}},
                                             {"light", {add_light_cases, add_water_cases, add_cloud_cases}}};
    return table;
}

// A case's own stream, so that its inputs depend neither on other cases nor on threads.
Random random_of(const Case& c, std::uint64_t seed) {
    std::uint64_t key = noise::mix64(seed);
    for (const char letter : c.group + "/" + c.name) key = noise::mix64(key + static_cast<unsigned char>(letter));
    return Random(key);
}

// Leaves the SIMD target as it was.
class TargetGuard {
  public:
    TargetGuard() : target_(noise::simd_target()) {}
    ~TargetGuard() { noise::pin_simd_target(target_); }
    TargetGuard(const TargetGuard&) = delete;
    TargetGuard& operator=(const TargetGuard&) = delete;

  private:
    std::string target_;
};

}  // namespace

std::vector<std::string> groups() {
    std::vector<std::string> names;
    for (const Group& group : all_groups()) names.emplace_back(group.name);
    return names;
}

std::vector<Case> cases_of(const std::vector<std::string>& chosen) {
    std::vector<Case> cases;
    for (const Group& group : all_groups()) {
        if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), group.name) == chosen.end()) continue;
        for (const auto add : group.add) add(cases);
    }
    return cases;
}

std::vector<Row> run_cases(const std::vector<Case>& cases, const Settings& settings, int threads,
                           const OnCase& on_case) {
    const TargetGuard guard;
    std::vector<std::string> targets;
    for (const Case& c : cases) {
        if (std::find(targets.begin(), targets.end(), c.simd_target) == targets.end()) targets.push_back(c.simd_target);
    }
    std::vector<std::vector<Row>> found(cases.size());
    std::mutex mutex;
    std::size_t done = 0;
    parallel::ThreadPool pool(threads);
    for (const std::string& target : targets) {
        noise::pin_simd_target(target.empty() ? noise::simd_targets().front() : target);
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            if (cases[i].simd_target == target) chosen.push_back(i);
        }
        pool.run(static_cast<std::int64_t>(chosen.size()), [&](int, std::int64_t index) {
            const std::size_t i = chosen[static_cast<std::size_t>(index)];
            if (settings.cancelled()) return;
            {
                const std::lock_guard lock(mutex);
                on_case(done, cases.size(), cases[i]);
            }
            Random random = random_of(cases[i], settings.seed);
            std::vector<Row> rows = cases[i].run(settings, random);
            if (settings.cancelled()) return;
            for (Row& row : rows) row.group = cases[i].group;
            found[i] = std::move(rows);
            const std::lock_guard lock(mutex);
            ++done;
        });
    }
    std::vector<Row> rows;
    for (std::vector<Row>& of_case : found) std::move(of_case.begin(), of_case.end(), std::back_inserter(rows));
    return rows;
}

}  // namespace strata::tools::stability
