#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "src/scene/typed_number.h"

using namespace strata::scene;

TEST_CASE("a decimal number may lack digits on one side of its point, and have a sign and an exponent") {
    CHECK(typed_number(".5") == 0.5);
    CHECK(typed_number("5.") == 5.0);
    CHECK(typed_number("+1") == 1.0);
    CHECK(typed_number("-.5e+2") == -50.0);
    CHECK(typed_number("1E3") == 1000.0);
    CHECK(typed_number("0.1") == 0.1);
    CHECK(typed_number("1e-999") == 0.0);
    for (const char* text : {"", ".", "+", "+-1", "--1", "1e", "1e+", ".e1", "1.2.3", "0x10", "inf", "nan", "1 ", " 1",
                             "1,5", "1e999", "-1e999"}) {
        CAPTURE(text);
        CHECK_FALSE(typed_number(text).has_value());
    }
}

TEST_CASE("a whole number may have a sign and an exponent, but nothing behind the point") {
    CHECK(typed_integer<int>("+7") == 7);
    CHECK(typed_integer<int>("-7") == -7);
    CHECK(typed_integer<int>("1e3") == 1000);
    CHECK(typed_integer<int>("1.5e1") == 15);
    CHECK(typed_integer<int>("2147483647") == 2147483647);
    CHECK(typed_integer<std::uint64_t>("18446744073709551615") == UINT64_MAX);
    for (const char* text : {"", "+", "+-7", "1.5", "2147483648", "3e9", "-3e9", "7x", "1e16"}) {
        CAPTURE(text);
        CHECK_FALSE(typed_integer<int>(text).has_value());
    }
    CHECK_FALSE(typed_integer<std::uint64_t>("-1").has_value());
    CHECK_FALSE(typed_integer<std::uint64_t>("1e17").has_value());
}

TEST_CASE("numbers of a TOML value get the digits that TOML asks for, and nothing else changes") {
    CHECK(with_toml_numbers("[.5, 1., -.25e3]") == "[0.5, 1.0, -0.25e3]");
    CHECK(with_toml_numbers("{ time_s = .5 }") == "{ time_s = 0.5 }");
    CHECK(with_toml_numbers("'5. of' \".5\\\" .5\"") == "'5. of' \".5\\\" .5\"");
    CHECK(with_toml_numbers("1979-05-27 v1. a.b +.inf 0.5") == "1979-05-27 v1. a.b +.inf 0.5");
}
