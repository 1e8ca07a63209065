#include "tools/sweep/axes.h"

#include <doctest/doctest.h>

#include <cctype>
#include <set>

#include "tools/cli/errors.h"

using namespace strata::tools::cli;
using namespace strata::tools::sweep;

namespace {

using Options = std::vector<AxisOption>;

Axes parse(const Options& lists, const Options& anywhere = {}, const Options& rows = {}, const Options& columns = {}) {
    return parse_axes({lists, anywhere, rows, columns});
}

Axis axis(std::vector<std::string> values, std::string key = "sampling.N") {
    return {"--axis", std::move(key), std::move(values)};
}

void check_refused(const char* words, const Options& lists, const Options& anywhere = {}, const Options& rows = {},
                   const Options& columns = {}) {
    CHECK_THROWS_WITH_AS(parse(lists, anywhere, rows, columns), doctest::Contains(words), UsageError);
}

}  // namespace

TEST_CASE("N makes the columns and m the rows, in whatever order and beside whatever else they stand") {
    const Axes both = parse({{"--m", "1,4,15"}, {"--N", "1,2"}});
    CHECK(both.columns->key == "sampling.N");
    CHECK(both.rows->key == "sampling.m");
    CHECK(both.rows->values == std::vector<std::string>{"1", "4", "15"});
    CHECK(parse({{"--m", "1,2"}, {"--estimator", "sobol,random"}}).rows->key == "sampling.m");
    CHECK(parse({{"--N", "1,2"}, {"--estimator", "sobol,random"}}).columns->key == "sampling.N");
    CHECK(parse({{"--N", "1,2"}}, {{"--axis", "octaves=3,4"}}).rows->key == "surface.octaves");
    CHECK(parse({{"--N", "1,2"}}, {}, {}, {{"--columns", "fov_deg=30,40"}}).rows->key == "sampling.N");
    CHECK(parse({{"--N", "1,2"}}, {}, {{"--rows", "fov_deg=30,40"}}).columns->key == "sampling.N");
}

TEST_CASE("one axis is enough, and lists of one value stand beside two axes") {
    CHECK(parse({{"--m", "1,2"}}).columns->key == "sampling.m");
    CHECK_FALSE(parse({{"--m", "1,2"}}).rows.has_value());
    CHECK(parse({{"--m", "3"}}).columns->values.size() == 1);
    const Axes axes = parse({{"--N", "1,2"}, {"--m", "1,4"}, {"--estimator", "sobol"}, {"--seed", "7"}});
    REQUIRE(axes.fixed.size() == 2);
    CHECK(axes.fixed[0].key == "sampling.estimator");
    CHECK(axes.fixed[1].values == std::vector<std::string>{"7"});
    CHECK_FALSE(parse({}, {}, {{"--rows", "seed=1,2"}}).columns.has_value());
}

TEST_CASE("axes that cannot be are refused with what is wrong") {
    check_refused("nothing to vary", {});
    check_refused("octvaes", {}, {{"--axis", "octvaes=1,2"}});
    check_refused("did you mean", {}, {{"--axis", "surface.octvaes=1,2"}});
    check_refused("KEY=VALUE", {}, {{"--axis", "octaves"}});
    check_refused("an empty value", {{"--N", ""}});
    check_refused("an empty value", {{"--N", "1,,2"}});
    check_refused("an empty value", {{"--N", "1,2,"}});
    check_refused("an empty value", {}, {{"--axis", "octaves="}});
    check_refused("stands twice", {{"--N", "1,2,1"}});
    check_refused("stands twice", {{"--N", "1,2,.1e1"}});
    check_refused("stands twice", {{"--seed", "9007199254740993,+9007199254740993"}});
    check_refused("both vary sampling.N", {{"--N", "1,2"}, {"--N", "3,4"}});
    check_refused("both vary sampling.N", {{"--N", "1,2"}}, {{"--axis", "sampling.N=3,4"}});
    check_refused("both vary sampling.m", {}, {}, {{"--rows", "m=1,2"}}, {{"--columns", "m=3,4"}});
    check_refused("a third axis", {{"--N", "1,2"}, {"--m", "1,2"}, {"--seed", "1,2"}});
    check_refused("given twice", {}, {}, {{"--rows", "m=1,2"}, {"--rows", "N=1,2"}});
    std::string many = "1";
    for (int i = 2; i <= kMostValues + 1; ++i) many.append(",").append(std::to_string(i));
    check_refused("at most 100", {{"--seed", many}});
    std::string some = "1";
    for (int i = 2; i <= 21; ++i) some.append(",").append(std::to_string(i));
    check_refused("at most 400", {{"--seed", some}, {"--m", some}});
}

TEST_CASE("lists are cut at commas outside of brackets and quotes") {
    const auto values = [](const char* text) {
        return parse({}, {{"--axis", std::string("title=") + text}}).columns->values;
    };
    CHECK(values("1, 2,10") == std::vector<std::string>{"1", "2", "10"});
    CHECK(values("[1,2,3], [4,5,6]") == std::vector<std::string>{"[1,2,3]", "[4,5,6]"});
    CHECK(values("\"a,b\",'c,d'") == std::vector<std::string>{"\"a,b\"", "'c,d'"});
    check_refused("brackets do not match", {{"--N", "1,[2"}});
}

TEST_CASE("file names sort as numbers do, are plain and differ for different values") {
    CHECK(file_part(axis({"1", "2", "10"}), 1) == "N02");
    CHECK(file_part(axis({"1", "2", "100"}), 0) == "N001");
    CHECK(file_part(axis({"1"}, "sampling.time_order"), 0) == "l01");
    CHECK(file_part(axis({"0.5", "1e3"}, "camera.fov_deg"), 0) == "fov_deg0.5");
    for (const Axis& a : {axis({"[1,2,3]", "[1 2 3]", "(1,2,3)"}), axis({"1", "01", "001"}),
                          axis({"\"../x\"", "..!x", "a/b", "a\\b", "A_B"}), axis({"ab", "AB", "aB"})}) {
        std::set<std::string> names;
        for (std::size_t i = 0; i < a.values.size(); ++i) {
            std::string name = file_part(a, i);
            CHECK(name.find_first_of("/\\ []\"") == std::string::npos);
            for (char& c : name) c = static_cast<char>(std::tolower(c));
            CHECK_MESSAGE(names.insert(name).second, name);
        }
    }
}

TEST_CASE("labels name the value as the paper does") {
    CHECK(value_label(axis({"2"}), 0) == "N = 2");
    CHECK(value_label(axis({"3"}, "sampling.time_order"), 0) == "l = 3");
    CHECK(value_label(axis({"none"}, "sampling.estimator"), 0) == "no antialiasing");
    CHECK(value_label(axis({"sobol"}, "sampling.estimator"), 0) == "sobol");
}
