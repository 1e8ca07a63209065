#include "tools/cli/command_line.h"

#include <doctest/doctest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/errors.h"

using namespace strata::tools::cli;

namespace {

using Words = std::vector<std::string>;

// A command with options of every type, and what was read of them.
struct Program {
    Command program{"", "program"};
    int width = 7;
    std::optional<int> height;
    Words lists;
    int runs = 0;

    Program() {
        program.add_option("-w,--width", width, 1, 64, "n", "");
        program.add_option("--height", height, 1, 64, "n", "");
        const auto read = [this](const std::string& text) { lists.push_back(text); };
        program.add_option("--list", read, "LIST", "")->repeated();
        program.action([this] {
            ++runs;
            return 3;
        });
    }

    void run(Words words) {
        std::ranges::reverse(words);  // CLI11 takes them from the end
        program.app().parse(words);
    }
};

}  // namespace

TEST_CASE("typed options are read, keep their defaults where they are not given, and the last of several counts") {
    Program program;
    program.run({"--height", "5", "--height", "1e1"});
    CHECK(program.width == 7);
    CHECK(program.height == 10);
    CHECK(program.runs == 1);
    CHECK(program.program.exit_code() == 3);
    program.run({"-w", "64"});
    CHECK(program.width == 64);
}

TEST_CASE("an option that is repeated is read each time, commas and brackets untouched") {
    Program program;
    program.run({"--list", "[1,2],3", "--list", "[4,5]"});
    CHECK(program.lists == Words{"[1,2],3", "[4,5]"});
}

TEST_CASE("a value that is no whole number of the range is refused with the option, the value and the range") {
    for (const char* text : {"0", "65", "2.5", "two", "99999999999"}) {
        Program program;
        const std::string message = std::string("-w ") + text + ": allowed: a whole number, 1 to 64";
        CHECK_THROWS_WITH_AS(program.run({"--width", text}), message.c_str(), UsageError);
        CHECK(program.runs == 0);
    }
    Program program;
    CHECK_THROWS_AS(program.run({"--width", ""}), CLI::ParseError);
}

TEST_CASE("nothing is read where a word is unknown, and help comes before wrong values") {
    Program program;
    CHECK_THROWS_AS(program.run({"--list", "a", "--lisst", "b"}), CLI::ParseError);
    CHECK(program.lists.empty());
    CHECK_THROWS_AS(program.run({"--width", "none", "--help"}), CLI::CallForHelp);
}

TEST_CASE("names between commas are found, and the nearest is told of a wrong one") {
    const Words known{"octaves", "samples", "threads"};
    CHECK(parse_names("--only", "section", "threads,octaves", known) == std::vector<std::size_t>{2, 0});
    CHECK_THROWS_WITH_AS(parse_names("--only", "section", "octaves,octave", known),
                         "--only: 'octave' is no section, allowed: octaves, samples, threads; did you mean 'octaves'?",
                         UsageError);
    CHECK_THROWS_WITH_AS(parse_names("--only", "section", "", known), doctest::Contains("'' is no section"),
                         UsageError);
    CHECK(split_at_commas("a,,b,") == Words{"a", "", "b", ""});
}
