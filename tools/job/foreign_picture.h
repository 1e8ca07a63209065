// Pictures that are read to be shown or compared, of whatever program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "src/image/picture.h"
#include "src/scene/scene.h"

namespace strata::tools::job {

struct ForeignPicture {
    image::Picture linear;              // NaN and infinity included
    std::optional<scene::Scene> scene;  // that it was rendered from, where it says so
};

// `typed` is its name in messages. Warns of pixels that are not finite unless `quiet`. Throws UsageError for what
// cannot be read, SceneError for a scene that cannot.
ForeignPicture read_foreign_picture(const std::filesystem::path& path, const std::string& typed, bool quiet);

}  // namespace strata::tools::job
