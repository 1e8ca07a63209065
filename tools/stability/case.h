// A case of `strata stability`: a stiff or extreme situation, what is measured in it, and the bound that arithmetic or
// a stated contract gives. No bound is tuned: its derivation stands beside it.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "src/parallel/cancel.h"

namespace strata::tools::stability {

// What a row is for. `information` documents the paper's method or how far a bound is from being reached, and does not
// fail.
enum class Kind { check, information };

struct Row {
    std::string name;
    Kind kind = Kind::check;
    double measured = 0.0;
    double bound = 0.0;  // checks: measured <= bound
    std::string unit;
    std::string detail;   // the worst input, so that it can be replayed, and counts
    std::string group{};  // filled in by the runner

    bool pass() const { return kind == Kind::information || measured <= bound; }
};

struct Settings {
    bool fast = false;
    std::uint64_t seed = 1;
    const parallel::CancelToken* cancel = nullptr;

    bool cancelled() const { return cancel != nullptr && cancel->requested(); }
    // A number of trials: all of them, or the fast subset's.
    int trials(int full, int subset) const { return fast ? subset : full; }
};

using Random = std::mt19937_64;

struct Case {
    std::string group;
    std::string name;
    std::function<std::vector<Row>(const Settings&, Random&)> run;
    std::string simd_target{};  // runs with it pinned; empty: the machine's best
};

// The largest of what it sees, and where. NaN counts as larger than everything.
class Worst {
  public:
    // describe() -> std::string is called for a new largest value only.
    template <class Describe>
    void see(double value, const Describe& describe) {
        ++count_;
        if (value <= value_ || is_nan_) return;
        is_nan_ = value != value;
        value_ = value;
        where_ = describe();
    }

    double value() const { return value_; }
    const std::string& where() const { return where_; }
    long count() const { return count_; }

  private:
    double value_ = -1.0;
    bool is_nan_ = false;
    std::string where_;
    long count_ = 0;
};

// What was measured is to be no more than the bound.
inline Row check(std::string name, double measured, double bound, std::string unit, std::string detail) {
    return {std::move(name), Kind::check, measured, bound, std::move(unit), std::move(detail)};
}
inline Row check(std::string name, const Worst& worst, double bound, std::string unit) {
    return check(std::move(name), worst.value(), bound, std::move(unit), worst.where());
}
inline Row information(std::string name, double measured, std::string unit, std::string detail) {
    return {std::move(name), Kind::information, measured, 0.0, std::move(unit), std::move(detail)};
}
inline Row information(std::string name, const Worst& worst, std::string unit) {
    return information(std::move(name), worst.value(), std::move(unit), worst.where());
}

// One function a file; each appends its cases.
void add_bspline_cases(std::vector<Case>& cases);
void add_paper_cases(std::vector<Case>& cases);
void add_noise_cases(std::vector<Case>& cases);
void add_noise_sum_cases(std::vector<Case>& cases);
void add_tracing_cases(std::vector<Case>& cases);
void add_random_scene_cases(std::vector<Case>& cases);
void add_shadow_cases(std::vector<Case>& cases);
void add_invariance_cases(std::vector<Case>& cases);
void add_sum_cases(std::vector<Case>& cases);
void add_motion_cases(std::vector<Case>& cases);
void add_light_cases(std::vector<Case>& cases);
void add_water_cases(std::vector<Case>& cases);
void add_cloud_cases(std::vector<Case>& cases);

}  // namespace strata::tools::stability
