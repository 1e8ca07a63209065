#include "tools/job/exr_format.h"

#include <fmt/format.h>

#include "src/scene/key_text.h"
#include "tools/cli/errors.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::job {

image::ExrFormat parse_exr_format(const std::string& name, const char* allowed) {
    for (const image::ExrFormat format : {image::ExrFormat::half, image::ExrFormat::floating}) {
        if (name == name_of(format)) return format;
    }
    throw cli::UsageError(fmt::format("--format {}: allowed: {}", scene::excerpt(name), allowed));
}

const char* name_of(image::ExrFormat format) { return format == image::ExrFormat::half ? "half" : "float"; }

void warn_of_clipping(const std::string& what) {
    cli::print_error(fmt::format("warning: {}; --format float keeps it", what));
}

}  // namespace strata::tools::job
