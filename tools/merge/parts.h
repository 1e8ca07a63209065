// The parts of a picture that are given to be put together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/film/shard.h"
#include "src/image/metadata.h"
#include "src/image/picture.h"

namespace strata::tools::merge {

struct Part {
    std::filesystem::path path;
    film::Shard shard;
};

struct Parts {
    std::vector<Part> parts;      // each shard once, in their order
    image::Metadata metadata;     // of the whole
    std::filesystem::path first;  // a file to read the scene from
};

// Looks at all files, decoding no pixel. Throws UsageError, naming files and what differs, for a file that is no part,
// is damaged, or is of another picture, other settings, version or SIMD target than the first; for two files of one
// shard that differ (equal ones count once); and for shards that are missing.
Parts find_parts(const std::vector<std::string>& files);

}  // namespace strata::tools::merge
