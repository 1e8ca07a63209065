// A scene rendered to a picture in memory.
#pragma once

#include <cstddef>

#include "src/image/picture.h"
#include "src/integrate/surface_image.h"
#include "src/render/progressive.h"
#include "src/render/render.h"
#include "src/scene/scene.h"

namespace strata::tools::job {

struct RenderedPicture {
    image::Picture picture;  // black where it is not finished
    std::size_t finished_pixels = 0;
    render::RenderResult result;  // its film has become the picture
};

// Renders the pixels `window` of a valid scene's frame.
RenderedPicture render_picture(const scene::Scene& scene, const film::Rect& window, integrate::Tracer tracer,
                               const render::RenderOptions& options);

struct ProgressivePicture {
    image::Picture picture;  // black where it is not finished
    std::size_t finished_pixels = 0;
    render::ProgressiveResult result;  // its film has become the picture
};

// The same in passes until the goal is reached.
ProgressivePicture render_picture(const scene::Scene& scene, const film::Rect& window, integrate::Tracer tracer,
                                  const render::PassGoal& goal, const render::RenderOptions& options);

}  // namespace strata::tools::job
