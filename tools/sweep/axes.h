// What a sweep varies: one or two keys of the scene, each over a list of values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/scene/scene.h"

namespace strata::tools::sweep {

struct Axis {
    std::string origin;               // the option it was given to, for messages
    std::string key;                  // "sampling.N"
    std::vector<std::string> values;  // as typed, at least one, all different
};

// As typed: the option and its text.
struct AxisOption {
    std::string origin;
    std::string text;
};

// The keys that have an option of their own.
struct AxisName {
    const char *option, *names, *key, *type, *meaning;
};
inline constexpr AxisName kAxisNames[] = {
    {"--N", "-N,--N", "sampling.N", "N,...", "Samples a side, as 1,2,3,10: the columns"},
    {"--m", "-m,--m", "sampling.m", "M,...", "Orders of the B-spline filter, as 1,4,15: the rows"},
    {"--estimator", "--estimator", "sampling.estimator", "NAME,...", "Estimators, as none,stratified,sobol"},
    {"--time-order", "--time-order", "sampling.time_order", "L,...", "Orders of the B-spline filter in time"},
    {"--seed", "--seed", "sampling.seed", "S,...", "Seeds of the sample positions"}};

struct AxisRequest {
    std::vector<AxisOption> lists;          // of a known key: {"--N", "1,2,3"}
    std::vector<AxisOption> anywhere;       // {"--axis", "octaves=4,8"}
    std::vector<AxisOption> rows, columns;  // the same, where it has a place; at most one each
};

struct Axes {
    std::optional<Axis> rows, columns;  // one of them at least
    std::vector<Axis> fixed;            // of one value, beside axes of several
};

inline constexpr int kMostValues = 100;  // of an axis: a sheet's side ends somewhere
inline constexpr int kMostCells = 400;

// N goes to the columns and m to the rows unless --rows or --columns says otherwise. Throws UsageError for unknown
// keys, with the nearest, empty lists and values, a value or a key twice, more than two axes, too many values.
Axes parse_axes(const AxisRequest& request);

// The last part of a key, "l" for the order in time: as axes are called in labels and file names.
std::string axis_name(const Axis& axis);

// "N02" for sampling.N=2: whole numbers are padded to the axis's longest, at least two digits; characters that file
// names should not have become '_'. Different for different values of an axis.
std::string file_part(const Axis& axis, std::size_t value);

// "N = 2".
std::string value_label(const Axis& axis, std::size_t value);

}  // namespace strata::tools::sweep
