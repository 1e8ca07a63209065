#include "tools/stability/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "tools/report/json.h"
#include "tools/report/table.h"

namespace strata::tools::stability {

namespace {

const char* verdict(const Row& row) {
    if (row.kind == Kind::information) return "info";
    return row.pass() ? "pass" : "FAIL";
}

std::string bound_text(const Row& row) {
    return row.kind == Kind::information ? "-" : fmt::format("{:.3g}", row.bound);
}

std::string summary(const std::vector<Row>& rows) {
    const auto checks = std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.kind == Kind::check; });
    return fmt::format("{} checks, {} failed; {} rows of information", checks, failures(rows),
                       static_cast<std::ptrdiff_t>(rows.size()) - checks);
}

// Calls tell(group, its rows) for each group, whose rows are side by side.
template <class Tell>
void for_each_group(const std::vector<Row>& rows, const Tell& tell) {
    for (auto first = rows.begin(); first != rows.end();) {
        const auto last = std::find_if(first, rows.end(), [&](const Row& row) { return row.group != first->group; });
        tell(first->group, std::span(first, last));
        first = last;
    }
}

}  // namespace

std::size_t failures(const std::vector<Row>& rows) {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const Row& r) { return !r.pass(); }));
}

std::string text_table(const std::vector<Row>& rows) {
    std::string text;
    for_each_group(rows, [&](const std::string& group, std::span<const Row> of_group) {
        report::Table table({group, ">measured", ">bound", "unit"});
        for (const Row& row : of_group) {
            table.add({fmt::format("{}  {}", verdict(row), row.name), fmt::format("{:.3g}", row.measured),
                       bound_text(row), row.unit},
                      row.pass() ? "" : fmt::format("      {}\n", row.detail));
        }
        text += table.text() + "\n";
    });
    return text + summary(rows) + "\n";
}

std::string markdown_table(const std::vector<Row>& rows, const Heading& heading) {
    std::string text = fmt::format(
        "# Numerical stability\n\n`strata stability{}{}`, strata {}, SIMD targets {}: {}.\n\nA bound is derived from "
        "the arithmetic or a stated contract, beside the case in `tools/stability/`. Rows without one document the "
        "paper's method, or how often a limit is met.\n",
        heading.fast ? " --fast" : "", heading.seed == 1 ? "" : fmt::format(" --seed {}", heading.seed), STRATA_VERSION,
        heading.simd_targets, summary(rows));
    for_each_group(rows, [&](const std::string& group, std::span<const Row> of_group) {
        report::Table table({"case", "measured", "bound", "unit", "", "worst input"});
        for (const Row& row : of_group) {
            table.add(
                {row.name, fmt::format("{:.3g}", row.measured), bound_text(row), row.unit, verdict(row), row.detail});
        }
        text += fmt::format("\n## {}\n\n{}", group, table.markdown());
    });
    return text;
}

std::string json_table(const std::vector<Row>& rows, const Heading& heading) {
    report::Json json = {{"version", STRATA_VERSION},
                         {"simd_targets", heading.simd_targets},
                         {"seed", heading.seed},
                         {"fast", heading.fast},
                         {"rows", report::Json::array()}};
    for (const Row& row : rows) {
        const bool check = row.kind == Kind::check;
        json["rows"].push_back({{"group", row.group},
                                {"case", row.name},
                                {"kind", check ? "check" : "information"},
                                {"measured", report::number(row.measured)},
                                {"bound", report::number(row.bound, check)},
                                {"unit", row.unit},
                                {"pass", row.pass()},
                                {"detail", row.detail}});
    }
    return report::text_of(json);
}

}  // namespace strata::tools::stability
