// A picture put together from its parts, while both are read and written from the top.
#pragma once

#include <filesystem>
#include <functional>

#include "tools/merge/parts.h"

namespace strata::tools::merge {

// Writes the very file that one render of the whole would have written. Of each part some rows are held at a time, all
// together about kStripRows rows of the whole. Calls tell(fraction) after each of these. Throws ImageError and
// UsageError; nothing is left then.
void write_whole(const Parts& parts, const std::filesystem::path& output, const std::function<void(double)>& tell,
                 const std::function<void(const std::string&)>& warn);

}  // namespace strata::tools::merge
