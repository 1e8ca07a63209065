// The table of rows as text, Markdown and JSON.
#pragma once

#include <string>
#include <vector>

#include "tools/stability/case.h"

namespace strata::tools::stability {

struct Heading {
    std::string simd_targets;  // "avx512, avx2, ..."
    std::uint64_t seed = 1;
    bool fast = false;
};

std::size_t failures(const std::vector<Row>& rows);

std::string text_table(const std::vector<Row>& rows);
std::string markdown_table(const std::vector<Row>& rows, const Heading& heading);

// {"version", "seed", "fast", "rows": [{group, case, kind, measured, bound, unit, pass, detail}]}; bound is null for
// information, measured null where it is not finite.
std::string json_table(const std::vector<Row>& rows, const Heading& heading);

}  // namespace strata::tools::stability
