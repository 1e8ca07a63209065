#include "tools/job/foreign_picture.h"

#include <fmt/format.h>

#include "src/image/image_error.h"
#include "src/image/metadata.h"
#include "src/image/not_finite.h"
#include "src/image/read.h"
#include "src/scene/toml_reader.h"
#include "tools/cli/errors.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::job {

ForeignPicture read_foreign_picture(const std::filesystem::path& path, const std::string& typed, bool quiet) {
    ForeignPicture picture;
    try {
        image::refuse_damaged(path);
        const auto text = image::read_metadata(path, image::kSceneKey);
        if (text) picture.scene = scene::read_scene(*text, typed);
        picture.linear =
            image::read_linear(path, picture.scene ? image::colour_out(picture.scene->film) : image::ColourOut());
    } catch (const image::ImageError& error) {
        throw cli::UsageError(error.what());
    }
    const std::string not_finite = image::describe_not_finite(picture.linear);
    if (!not_finite.empty() && !quiet) cli::print_error(fmt::format("warning: {}: {}", typed, not_finite));
    return picture;
}

}  // namespace strata::tools::job
