#include "tools/sweep/axes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "src/scene/key_text.h"
#include "src/scene/typed_number.h"
#include "tools/cli/errors.h"
#include "tools/job/column_settings.h"

namespace strata::tools::sweep {

namespace {

bool is_whole(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// "1" and "1e0" would be the same picture twice.
std::string canonical(const std::string& value) {
    if (const auto whole = scene::typed_integer<std::int64_t>(value)) return fmt::format("{}.0", *whole);
    const auto number = scene::typed_number(value);
    return number ? scene::number_text(*number) : value;
}

Axis make_axis(const std::string& origin, std::string_view key, std::string_view values) {
    Axis axis{.origin = origin, .key = job::full_key_name(origin, key), .values = {}};
    for (const std::string_view value : job::split_values(origin, values, ",")) axis.values.emplace_back(value);
    if (std::ranges::find(axis.values, "") != axis.values.end())
        throw cli::UsageError(fmt::format("{} '{}': an empty value, allowed: values between commas, such as 1,2,10",
                                          origin, scene::excerpt(values)));
    std::set<std::string> seen;
    for (const std::string& value : axis.values) {
        if (!seen.insert(canonical(value)).second)
            throw cli::UsageError(fmt::format("{}: the value {} stands twice", origin, scene::excerpt(value)));
    }
    if (axis.values.size() > kMostValues)
        throw cli::UsageError(
            fmt::format("{}: {} values, allowed: at most {}", origin, axis.values.size(), kMostValues));
    return axis;
}

// "octaves=4,8".
Axis make_axis(const AxisOption& option) {
    const auto equals = option.text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw cli::UsageError(fmt::format("{} {}: allowed: KEY=VALUE,VALUE,..., such as octaves=4,8", option.origin,
                                          scene::excerpt(option.text)));
    const std::string_view text = option.text;
    return make_axis(option.origin, text.substr(0, equals), text.substr(equals + 1));
}

std::vector<Axis> axes_without_place(const AxisRequest& request) {
    std::vector<Axis> axes;
    for (const AxisName& name : kAxisNames) {
        for (const AxisOption& option : request.lists)
            if (option.origin == name.option) axes.push_back(make_axis(option.origin, name.key, option.text));
    }
    for (const AxisOption& option : request.anywhere) axes.push_back(make_axis(option));
    return axes;
}

std::optional<Axis> axis_with_place(const std::vector<AxisOption>& options) {
    if (options.size() > 1) throw cli::UsageError(fmt::format("{}: given twice, allowed: once", options[1].origin));
    if (options.empty()) return std::nullopt;
    return make_axis(options.front());
}

void check_all_different(const Axes& axes, const std::vector<Axis>& others) {
    std::vector<const Axis*> all;
    if (axes.rows) all.push_back(&*axes.rows);
    if (axes.columns) all.push_back(&*axes.columns);
    for (const Axis& axis : others) all.push_back(&axis);
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (all[i]->key == all[k]->key)
                throw cli::UsageError(fmt::format("{} and {} both vary {}, allowed: one of them", all[k]->origin,
                                                  all[i]->origin, all[i]->key));
        }
    }
}

bool wants_columns(const Axis& axis) { return axis.key == "sampling.N"; }
bool wants_rows(const Axis& axis) { return axis.key == "sampling.m"; }

void place(Axes& axes, std::vector<Axis> varying) {
    if (varying.size() == 2 && (wants_columns(varying[1]) || wants_rows(varying[0])))
        std::swap(varying[0], varying[1]);  // the first goes to the columns
    for (Axis& axis : varying) {
        std::optional<Axis>& place = axes.columns ? axes.rows : axes.columns;
        if (place)
            throw cli::UsageError(
                fmt::format("{}: a third axis, allowed: two of several values, others of one value", axis.origin));
        place = std::move(axis);
    }
}

std::string sanitised(std::string_view value) {
    std::string name;
    for (const char c : value) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
                           c == '-' || c == '+';
        name += plain ? c : '_';
    }
    return name;
}

}  // namespace

Axes parse_axes(const AxisRequest& request) {
    Axes axes;
    axes.rows = axis_with_place(request.rows);
    axes.columns = axis_with_place(request.columns);
    std::vector<Axis> others = axes_without_place(request);
    check_all_different(axes, others);

    std::vector<Axis> varying;
    for (Axis& axis : others) (axis.values.size() > 1 ? varying : axes.fixed).push_back(std::move(axis));
    place(axes, std::move(varying));
    // A list of one value is an axis where there is no other.
    if (!axes.rows && !axes.columns && !axes.fixed.empty()) {
        axes.columns = std::move(axes.fixed.front());
        axes.fixed.erase(axes.fixed.begin());
    }
    if (!axes.rows && !axes.columns)
        throw cli::UsageError(
            "nothing to vary: give one or two of --N, --m, --estimator, --time-order, --seed, --axis, --rows, "
            "--columns");
    const std::size_t cells =
        (axes.rows ? axes.rows->values.size() : 1) * (axes.columns ? axes.columns->values.size() : 1);
    if (cells > kMostCells)
        throw cli::UsageError(fmt::format("{} pictures: allowed: at most {} in a sweep", cells, kMostCells));
    return axes;
}

std::string axis_name(const Axis& axis) {
    if (axis.key == "sampling.time_order") return "l";
    return axis.key.substr(axis.key.rfind('.') + 1);
}

std::string file_part(const Axis& axis, std::size_t value) {
    std::size_t digits = 2;
    for (const std::string& v : axis.values)
        if (is_whole(v)) digits = std::max(digits, v.size());
    const auto part = [&](const std::string& v) {
        return is_whole(v) ? std::string(digits - v.size(), '0') + v : sanitised(v);
    };
    const std::string own = part(axis.values[value]);
    // Letters of either case may be the same file.
    const auto alike = [&](const std::string& v) {
        return std::ranges::equal(
            part(v), own, {}, [](char c) { return std::tolower(c); }, [](char c) { return std::tolower(c); });
    };
    const bool unique = std::ranges::count_if(axis.values, alike) == 1;
    return axis_name(axis) + own + (unique ? "" : fmt::format("-{}", value + 1));
}

std::string value_label(const Axis& axis, std::size_t value) {
    const std::string& text = axis.values[value];
    if (axis.key == "sampling.estimator") return text == "none" ? "no antialiasing" : text;
    return fmt::format("{} = {}", axis_name(axis), text);
}

}  // namespace strata::tools::sweep
