// What a picture says of itself, so that it can be rendered again.
#pragma once

#include <string>

#include "src/image/metadata.h"
#include "src/render/film.h"
#include "src/scene/scene.h"

namespace strata::tools {

// tracer and exr_format by their names on the command line. Nothing here differs between equal renders.
image::Metadata picture_metadata(const scene::Scene& scene, const render::Window& window, const std::string& tracer,
                                 const std::string& exr_format);

}  // namespace strata::tools
