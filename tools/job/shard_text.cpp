#include "tools/job/shard_text.h"

#include <fmt/format.h>

#include "src/scene/key_text.h"
#include "tools/cli/errors.h"
#include "tools/cli/scene_argument.h"

namespace strata::tools::job {

film::Shard parse_shard(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos) {
        throw cli::UsageError(
            fmt::format("--shard {}: allowed: a number and how many there are, as 3/16", scene::excerpt(text)));
    }
    const int count = cli::parse_integer("--shard: their number", text.substr(slash + 1), 1, film::kMostShards);
    return {cli::parse_integer("--shard", text.substr(0, slash), 1, count), count};
}

std::string shard_text(const film::Shard& shard) { return fmt::format("{}/{}", shard.number, shard.count); }

}  // namespace strata::tools::job
