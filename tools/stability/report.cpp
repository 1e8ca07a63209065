#include "tools/stability/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/report/json.h"

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

// Inside a cell of a Markdown table.
std::string cell(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '|') escaped += '\\';
        escaped += letter;
    }
    return escaped;
}

}  // namespace

std::size_t failures(const std::vector<Row>& rows) {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const Row& r) { return !r.pass(); }));
}

std::string text_table(const std::vector<Row>& rows) {
    std::size_t width = 4;
    for (const Row& row : rows) width = std::max(width, row.name.size());
    std::string text, group;
    for (const Row& row : rows) {
        if (row.group != group) {
            text += fmt::format("{}{:<{}}  {:>10}  {:>10}  {:<14}\n", text.empty() ? "" : "\n", row.group, width + 6,
                                "measured", "bound", "unit");
        }
        group = row.group;
        text += fmt::format("{}  {:<{}}  {:>10}  {:>10}  {:<14}\n", verdict(row), row.name, width,
                            fmt::format("{:.3g}", row.measured), bound_text(row), row.unit);
        if (!row.pass()) text += fmt::format("      {}\n", row.detail);
    }
    return text + "\n" + summary(rows) + "\n";
}

std::string markdown_table(const std::vector<Row>& rows, const Heading& heading) {
    std::string text = fmt::format(
        "# Numerical stability\n\n`strata stability{}{}`, strata {}, SIMD targets {}: {}.\n\nA bound is derived from "
        "the arithmetic or a stated contract, beside the case in `tools/stability/`. Rows without one document the "
        "paper's method, or how often a limit is met.\n",
        heading.fast ? " --fast" : "", heading.seed == 1 ? "" : fmt::format(" --seed {}", heading.seed), STRATA_VERSION,
        heading.simd_targets, summary(rows));
    std::string group;
    for (const Row& row : rows) {
        if (row.group != group) {
            text += fmt::format(
                "\n## {}\n\n| case | measured | bound | unit | | worst input |\n|---|---|---|---|---|---|\n",
                row.group);
        }
        group = row.group;
        text += fmt::format("| {} | {:.3g} | {} | {} | {} | {} |\n", cell(row.name), row.measured, bound_text(row),
                            cell(row.unit), verdict(row), cell(row.detail));
    }
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
