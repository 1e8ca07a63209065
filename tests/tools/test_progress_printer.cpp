#include "tools/cli/progress_printer.h"

#include <doctest/doctest.h>

#include "tools/cli/status_line.h"

using namespace strata::tools::cli;

TEST_CASE("durations and the progress line read well") {
    CHECK(duration_text(-1) == "0 s");
    CHECK(duration_text(0.2) == "1 s");
    CHECK(duration_text(59.5) == "1 min 00 s");
    CHECK(duration_text(65) == "1 min 05 s");
    CHECK(duration_text(7380) == "2 h 03 min");
    CHECK(progress_line({0.42, 3100000, 1.0}) == " 42 %, 3.1 M rays/s, 2 s left");
    CHECK(progress_line({0.0, 0, 0.0}) == "  0 %, 0 M rays/s");
}

TEST_CASE("a render is called long only on a sufficient basis") {
    CHECK(!predicted_long({0.0001, 1, 1.0}));
    CHECK(predicted_long({0.0001, 1, 2.0}));
    CHECK(predicted_long({0.0049, 1, 3.0}));
    CHECK(!predicted_long({0.0051, 1, 3.0}));
    CHECK(!predicted_long({0.0, 0, 1000.0}));
}

TEST_CASE("a status line is cut to the terminal's width, its characters whole") {
    CHECK(cut_to_columns("12345", 5) == "12345");
    CHECK(cut_to_columns("12345", 4) == "1234");
    CHECK(cut_to_columns("Größe", 4) == "Größ");
    CHECK(cut_to_columns("山山", 1) == "山");
    CHECK(cut_to_columns("abc", 0).empty());
    CHECK(cut_to_columns("", 3).empty());
}
