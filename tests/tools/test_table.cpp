#include "tools/report/table.h"

#include <doctest/doctest.h>

#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace strata::tools::report;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace

TEST_CASE("columns of text are as wide as what is in them, numbers end and words begin below one another") {
    Table table({"name", ">rays", "note"});
    table.add({"a", "12", "x"});
    table.add({"longer", "1234567", ""}, "below\n");
    table.add({"short"});
    CHECK(lines_of(table.text()) == std::vector<std::string>{"name       rays  note",  //
                                                             "a            12  x",     //
                                                             "longer  1234567",        //
                                                             "below",                  //
                                                             "short"});
    CHECK_THROWS_AS(table.add({"1", "2", "3", "4"}), std::logic_error);
}

TEST_CASE("every row of Markdown has all columns, whatever is in its cells") {
    Table table({"case", ">measured", ""});
    table.add({"|x| <= 1", "2"}, "not told\n");
    CHECK(lines_of(table.markdown()) ==
          std::vector<std::string>{"| case | measured |  |", "|---|---|---|", "| \\|x\\| <= 1 | 2 |  |"});
}

TEST_CASE("a spreadsheet has the rows' keys above their values, quoted where they would break a line or a cell") {
    std::vector<Json> rows;
    CHECK(csv_of(rows).empty());
    rows.push_back({{"file", "a.exr"}, {"of, any", "1,2"}, {"rays", 18446744073709551615u}, {"rmse", Json()}});
    rows.push_back({{"file", "say \"b\"\n"},
                    {"of, any", true},
                    {"rays", 0},
                    {"rmse", number(std::numeric_limits<double>::quiet_NaN())}});
    CHECK(csv_of(rows) ==
          "file,\"of, any\",rays,rmse\n"
          "a.exr,\"1,2\",18446744073709551615,\n"
          "\"say \"\"b\"\"\n\",true,0,\n");
}
