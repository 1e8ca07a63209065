// The counts of a render lie where `strata explain` says: built-in scenes at more sizes than the fast test has time
// for.
#include <doctest/doctest.h>

#include <utility>

#include "tests/tools/explained_counts.h"

using namespace strata::tools::explain::testing;
using namespace strata;

TEST_CASE("counts of every built-in scene lie within their intervals, at several sizes and N") {
    Verdicts verdicts;
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) {
        for (const auto& [width, N] : {std::pair(160, 4), {320, 2}, {480, 1}}) {
            judge(builtin.name, builtin_of_size(builtin, width, N), verdicts);
        }
    }
    conclude(verdicts);
}
