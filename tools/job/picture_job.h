// A picture as it is asked for: a scene's pixels and what renders them. Nothing of it says how: threads, progress and
// stopping are the batch's that it is rendered in (batch.h).
#pragma once

#include <string>

#include "src/film/film.h"
#include "src/image/encode.h"
#include "src/image/metadata.h"
#include "src/image/picture.h"
#include "src/integrate/surface_image.h"
#include "src/render/render.h"
#include "src/scene/scene.h"

namespace strata::tools::job {

struct PictureJob {
    scene::Scene scene;  // valid
    film::Rect window;   // pixels of the scene's frame
    integrate::Tracer tracer = integrate::Tracer::fast;

    image::PictureShape shape() const;

    // Nearly: what its share of a batch's work is taken to be.
    double expected_rays() const;

    // What a file of it says of itself, so that it can be rendered again. exr_format: "half" or "float".
    image::Metadata metadata(const std::string& exr_format) const;

    // For the EXR that keeps the radiance as it was computed, whose metadata are those of "float".
    image::WriteOptions float_exr() const;
};

// The whole frame.
PictureJob whole_frame(scene::Scene scene, integrate::Tracer tracer = integrate::Tracer::fast);

struct RenderedPicture {
    image::Picture picture;       // black where it is not finished
    render::RenderResult result;  // its film has become the picture
};

RenderedPicture render_picture(const PictureJob& job, const render::RenderOptions& options);

}  // namespace strata::tools::job
