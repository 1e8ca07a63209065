// Tables: for people as aligned text or Markdown, for spreadsheets as CSV of the rows that JSON files hold.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/report/json.h"

namespace strata::tools::report {

class Table {
  public:
    // A heading that begins with ">" is that of numbers, which are set to the right: ">rays".
    explicit Table(const std::vector<std::string>& headings);

    // A cell a column, or fewer. below: lines under the row, in text alone.
    void add(std::vector<std::string> cells, std::string below = "");

    // Columns as wide as what is in them, two spaces apart. Every line ends.
    std::string text() const;
    std::string markdown() const;

  private:
    struct Row {
        std::vector<std::string> cells;
        std::string below;
    };

    std::vector<Row> rows_;  // the first: headings
    std::vector<bool> is_number_;
};

// "name,rays\nedge,12\n": the keys of the first row above the values of all, which are in the same order; null is
// empty.
std::string csv_of(std::span<const Json> rows);

}  // namespace strata::tools::report
