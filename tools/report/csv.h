// Cells of tables for spreadsheets (RFC 4180).
#pragma once

#include <string>

namespace strata::tools::report {

// The text as a cell: quoted where it has a comma, a quote or a line end.
std::string csv_cell(const std::string& text);

}  // namespace strata::tools::report
