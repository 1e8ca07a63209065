#include "tools/job/render_picture.h"

#include <utility>

#include "src/integrate/make_image.h"

namespace strata::tools::job {

namespace {

// Takes the film, so that its memory is free again for the encoders.
image::Picture to_picture(film::Film film, const scene::Film& frame) {
    const film::Rect& w = film.window();
    image::Picture picture{frame.width, frame.height, w.x0, w.y0, w.x1, w.y1, {}};
    picture.rgb.reserve(3 * film.pixels().size());
    for (const glm::vec3& pixel : film.pixels()) picture.rgb.insert(picture.rgb.end(), {pixel.r, pixel.g, pixel.b});
    return picture;
}

}  // namespace

RenderedPicture render_picture(const scene::Scene& scene, const film::Rect& window, integrate::Tracer tracer,
                               const render::RenderOptions& options) {
    const auto image_function = integrate::make_image(scene, tracer);
    const estimate::Estimator estimator(estimate::estimator_settings(scene));
    RenderedPicture rendered;
    rendered.result = render::render(*image_function, estimator, window, options);
    rendered.finished_pixels = rendered.result.film.finished_count();
    rendered.picture = to_picture(std::exchange(rendered.result.film, {}), scene.film);
    return rendered;
}

ProgressivePicture render_picture(const scene::Scene& scene, const film::Rect& window, integrate::Tracer tracer,
                                  const render::PassGoal& goal, const render::RenderOptions& options) {
    const auto image_function = integrate::make_image(scene, tracer);
    ProgressivePicture rendered;
    rendered.result =
        render::render_progressively(*image_function, estimate::estimator_settings(scene), window, goal, options);
    rendered.finished_pixels = rendered.result.render.film.finished_count();
    rendered.picture = to_picture(std::exchange(rendered.result.render.film, {}), scene.film);
    return rendered;
}

}  // namespace strata::tools::job
