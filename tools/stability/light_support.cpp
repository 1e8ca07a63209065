#include "tools/stability/light_support.h"

#include <algorithm>
#include <cmath>

#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"

namespace strata::tools::stability {

glm::dvec3 towards(double elevation, double azimuth) {
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
}

glm::dvec3 any_direction(Random& random) {
    const double elevation = unit(random) < 0.5 ? 1e-4 * (unit(random) - 0.5) : std::asin(2.0 * unit(random) - 1.0);
    return towards(elevation, 2.0 * std::numbers::pi * unit(random));
}

double ill(const glm::dvec3& colour) {
    double worst = 0.0;
    for (int i = 0; i < 3; ++i) worst = std::max(worst, std::isfinite(colour[i]) ? -colour[i] : kInfinity);
    return worst;
}

SmallPicture small_picture(const char* name, const ChangeScene& change) {
    scene::Scene scene = scene::read_scene(scene::find_builtin(name)->text, name);
    scene.film.width = 24;
    scene.film.height = 16;
    scene.sampling.N = 2;
    change(scene);
    render::RenderOptions options;
    options.threads = 1;
    const auto image = integrate::make_image(scene);
    const estimate::Estimator estimator(estimate::estimator_settings(scene));
    const auto result = render::render(*image, estimator, {0, 0, scene.film.width, scene.film.height}, options);
    return {result.film.pixels(), result.counters};
}

double differing(const char* name, const ChangeScene& one, const ChangeScene& other) {
    const std::vector<glm::vec3> a = small_picture(name, one).pixels, b = small_picture(name, other).pixels;
    double count = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
    return count;
}

}  // namespace strata::tools::stability
