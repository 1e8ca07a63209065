#include "tools/job/picture_job.h"

#include <utility>

#include "src/image/picture_metadata.h"
#include "src/integrate/make_image.h"
#include "src/scene/needs.h"
#include "tools/cli/shared_options.h"

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

image::PictureShape PictureJob::shape() const {
    return {scene.film.width, scene.film.height, window.x0, window.y0, window.x1, window.y1};
}

double PictureJob::expected_rays() const {
    return 1.0 * scene::samples_a_pixel(scene.sampling) * window.width() * window.height();
}

image::Metadata PictureJob::metadata(const std::string& exr_format) const {
    return image::picture_metadata(scene, window, cli::name_of(tracer), exr_format);
}

image::WriteOptions PictureJob::float_exr() const {
    return {.exr_format = image::ExrFormat::floating, .frames_per_second = image::frame_rate(scene)};
}

PictureJob whole_frame(scene::Scene scene, integrate::Tracer tracer) {
    const film::Rect frame{0, 0, scene.film.width, scene.film.height};
    return {std::move(scene), frame, tracer};
}

RenderedPicture render_picture(const PictureJob& job, const render::RenderOptions& options) {
    const auto image_function = integrate::make_image(job.scene, job.tracer);
    const estimate::Estimator estimator(estimate::estimator_settings(job.scene));
    RenderedPicture rendered;
    rendered.result = render::render(*image_function, estimator, job.window, options);
    rendered.picture = to_picture(std::exchange(rendered.result.film, {}), job.scene.film);
    return rendered;
}

}  // namespace strata::tools::job
