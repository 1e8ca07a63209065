#include <doctest/doctest.h>

#include "src/journal/identity.h"

using namespace strata::journal;

namespace {

constexpr const char* kScene = R"(title = "hills # 1"

[sampling]
N = 4      # whole numbers
m = 2
# a remark
[[relief]]
kind = "fbm"
[[relief]]
kind = "sum"
inputs = ["a", "b"]
)";

Identity of(std::string text) {
    Identity identity;
    identity.set("version", "0.1");
    identity.set_lines(text);
    return identity;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("an identity is written and read back") {
    PayloadWriter writer;
    of(kScene).write(writer);
    PayloadReader reader(writer.bytes());
    CHECK(Identity::read(reader) == of(kScene));
    CHECK(reader.is_empty());
}

TEST_CASE("equal identities do not differ") { CHECK(differences(of(kScene), of(kScene)).empty()); }

TEST_CASE("what differs is named by section and key, with both values") {
    using Lines = std::vector<std::string>;
    CHECK(differences(of(kScene), of(replaced(kScene, "N = 4      # whole numbers", "N = 8 # other words"))) ==
          Lines{"sampling.N: 4 there, 8 here"});
    CHECK(differences(of(kScene), of(replaced(kScene, "m = 2\n", ""))) == Lines{"sampling.m: 2 there, nothing here"});
    CHECK(differences(of(replaced(kScene, "m = 2\n", "")), of(kScene)) == Lines{"sampling.m: nothing there, 2 here"});
    CHECK(differences(of(kScene), of(replaced(kScene, "\"sum\"", "\"warp\""))) ==
          Lines{"relief#2.kind: \"sum\" there, \"warp\" here"});
    CHECK(differences(of(kScene), of(replaced(kScene, "hills", "hulls"))) ==
          Lines{"title: \"hills # 1\" there, \"hulls # 1\" here"});
}

TEST_CASE("many differences are counted") {
    Identity there, here;
    for (int i = 0; i < 30; ++i) here.set("name" + std::to_string(i), "x");
    const std::vector<std::string> lines = differences(there, here, 5);
    CHECK(lines.size() == 6);
    CHECK(lines.back() == "and 25 more");
}

TEST_CASE("the same settings in another order are not the same") {
    Identity there, here;
    there.set("a", "1");
    there.set("b", "2");
    here.set("b", "2");
    here.set("a", "1");
    CHECK(differences(there, here).size() == 1);
}
