// What a picture says of itself, so that it can be rendered again.
#pragma once

#include <optional>
#include <string>

#include "src/film/film.h"
#include "src/image/encode.h"
#include "src/image/metadata.h"
#include "src/scene/scene.h"

namespace strata::image {

// tracer and exr_format by their names on the command line. Nothing here differs between equal renders.
Metadata picture_metadata(const scene::Scene& scene, const film::Rect& window, const std::string& tracer,
                          const std::string& exr_format);

// Adds what a picture of several passes has to say: their number, and all samples of a pixel. One pass says nothing: it
// is the plain render.
void set_passes(Metadata& metadata, const scene::Sampling& sampling, int passes);

// What an EXR says of its frame rate: nothing for the first frame of a scene in which nothing moves.
std::optional<FrameRate> frame_rate(const scene::Scene& scene);

}  // namespace strata::image
