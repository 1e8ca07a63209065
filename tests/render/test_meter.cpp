// The light meter.
#include "src/render/meter.h"

#include <doctest/doctest.h>

#include <cmath>

#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"

using namespace strata;

namespace {

scene::Scene builtin(const char* name) { return scene::read_scene(scene::find_builtin(name)->text, name); }

}  // namespace

TEST_CASE("an even picture is metered as mid grey, to a tenth of a stop") {
    scene::Scene scene = builtin("constant");
    for (const double value : {0.001, 0.02, 0.18, 0.5}) {
        scene.constant.value = value;
        CHECK(std::abs(render::metered_stops(scene) - std::log2(0.18 / value)) <= 0.0501);
    }
    scene.constant.value = 0.0;
    CHECK(render::metered_stops(scene) == 0.0);
}

TEST_CASE("twice the light is metered a stop lower") {
    scene::Scene scene = builtin("hills");
    scene.film.tone = scene::ToneCurve::agx;
    const double once = render::metered_stops(scene);
    scene.sun.intensity *= 2.0;
    scene.sky.zenith *= 2.0;
    scene.sky.horizon *= 2.0;
    CHECK(std::abs(once - 1.0 - render::metered_stops(scene)) <= 0.1001);
}

TEST_CASE("the frame's size does not change what is metered, nor a sky without light") {
    scene::Scene scene = builtin("hills");
    const double stops = render::metered_stops(scene);
    scene.film.width /= 8;
    scene.film.height /= 8;
    CHECK(render::metered_stops(scene) == stops);
    scene::Scene moon = builtin("moon");
    const double level = render::metered_stops(moon);
    moon.camera.look_at.y += 0.05 * glm::length(moon.camera.look_at - moon.camera.position);  // more of the sky
    CHECK(std::abs(render::metered_stops(moon) - level) <= 0.3);
    CHECK(level > 0.0);
}

TEST_CASE("a metered exposure is added to the scene's and asked for no more") {
    scene::Scene scene = builtin("hills");
    scene.film.exposure = 1.0;
    const double stops = render::metered_stops(scene);
    render::take_exposure(scene);
    CHECK(scene.film.exposure == 1.0);
    scene.film.metered = true;
    render::take_exposure(scene);
    CHECK(scene.film.exposure == doctest::Approx(1.0 + stops));
    CHECK_FALSE(scene.film.metered);
}
