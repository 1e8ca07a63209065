#include "src/integrate/make_image.h"
#include "src/library/render_setting.h"
#include "src/library/translate.h"

namespace strata {

RenderedImage render_image(const Scene& scene, const RenderOptions& options) {
    const RenderSetting setting(scene, options);
    RenderedImage made = translated([&] {
        const auto image = integrate::make_image(setting.scene(), setting.tracer());
        const render::ProgressiveResult result = render::render_progressively(
            *image, estimate::estimator_settings(setting.scene()), setting.window(), setting.goal(), setting.options());
        const film::Rect& w = setting.window();
        const scene::Film& frame = setting.scene().film;
        RenderedImage rendered{{frame.width, frame.height, {w.x0, w.y0, w.x1, w.y1}, {}}, report_of(result)};
        const std::vector<glm::vec3>& pixels = result.render.film.pixels();
        rendered.image.rgb.reserve(3 * pixels.size());
        for (const glm::vec3& pixel : pixels) {
            rendered.image.rgb.insert(rendered.image.rgb.end(), {pixel.r, pixel.g, pixel.b});
        }
        return rendered;
    });
    setting.rethrow_of_callback();
    return made;
}

}  // namespace strata
