#include "tools/report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace strata::tools::report {

namespace {

// Inside a cell of a Markdown table.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        if (letter == '|') result += '\\';
        result += letter;
    }
    return result;
}

// As spreadsheets have it (RFC 4180): quoted where it has a comma, a quote or a line end.
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted(1, '"');
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    return quoted += '"';
}

std::string csv_cell(const Json& value) {
    if (value.is_null()) return "";
    return value.is_string() ? csv_cell(value.get_ref<const std::string&>()) : value.dump();
}

}  // namespace

Table::Table(const std::vector<std::string>& headings) : rows_(1) {
    for (const std::string& heading : headings) {
        is_number_.push_back(heading.starts_with('>'));
        rows_[0].cells.push_back(heading.substr(is_number_.back() ? 1 : 0));
    }
}

void Table::add(std::vector<std::string> cells, std::string below) {
    if (cells.size() > is_number_.size()) throw std::logic_error("a row of a table has more cells than columns");
    cells.resize(is_number_.size());
    rows_.push_back({std::move(cells), std::move(below)});
}

std::string Table::text() const {
    std::vector<std::size_t> widths(is_number_.size(), 0);
    for (const Row& row : rows_) {
        for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row.cells[i].size());
    }
    std::string text;
    for (const Row& row : rows_) {
        std::string line;
        for (std::size_t i = 0; i < widths.size(); ++i) {
            const std::string space(widths[i] - row.cells[i].size(), ' ');
            line += (i > 0 ? "  " : "") + (is_number_[i] ? space + row.cells[i] : row.cells[i] + space);
        }
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n" + row.below;
    }
    return text;
}

std::string Table::markdown() const {
    std::string text;
    for (const Row& row : rows_) {
        text += "|";
        for (const std::string& cell : row.cells) text += fmt::format(" {} |", escaped(cell));
        text += "\n";
        if (&row != &rows_[0]) continue;
        text += "|";
        for (std::size_t i = 0; i < is_number_.size(); ++i) text += "---|";
        text += "\n";
    }
    return text;
}

std::string csv_of(std::span<const Json> rows) {
    std::string text;
    for (const Json& row : rows) {
        std::vector<std::string> names, values;
        for (const auto& [name, value] : row.items()) {
            names.push_back(csv_cell(name));
            values.push_back(csv_cell(value));
        }
        if (text.empty()) text = fmt::format("{}\n", fmt::join(names, ","));
        text += fmt::format("{}\n", fmt::join(values, ","));
    }
    return text;
}

}  // namespace strata::tools::report
