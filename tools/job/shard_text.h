// Which shard of a picture a file is, as it is typed and as the file says it: "3/16".
#pragma once

#include <string>
#include <string_view>

#include "src/film/shard.h"

namespace strata::tools::job {

inline constexpr std::string_view kShardKey = "strata:shard";

// Throws UsageError for what is none.
film::Shard parse_shard(const std::string& text);

std::string shard_text(const film::Shard& shard);

}  // namespace strata::tools::job
