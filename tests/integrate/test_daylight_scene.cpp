// Daylight over a scene's ground: units, the eye's height, the shadow of mountains that the scene does not have.
#include "shaders_cpu/daylight_scene.h"

#include <doctest/doctest.h>

#include <limits>

#include "src/integrate/make_image.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"

namespace {

using namespace strata;
using shaders::DaylightScene;

scene::Scene daylight_scene() {
    scene::Scene scene;
    scene.sky.model = scene::SkyModel::daylight;
    scene.scale.metres = 100.0;
    scene.sun.direction = {0.6, 0.5, -0.3};
    return scene;
}

DaylightScene daylight_of(const scene::Scene& scene, const glm::dvec3& eye = {0.0, 2.0, 0.0}) {
    return DaylightScene(scene, glm::normalize(scene.sun.direction), eye);
}

float luminance(const glm::vec3& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

}  // namespace

TEST_CASE("at the eye the air takes and adds nothing, far away it is all that is seen") {
    const DaylightScene air = daylight_of(daylight_scene());
    const glm::dvec3 level = glm::normalize(glm::dvec3(0.3, 0.02, 1.0));
    const glm::vec3 ground{0.2f, 0.1f, 0.05f};
    CHECK(air.air_along(level, 0.0).over(ground) == ground);
    const glm::vec3 near = air.air_along(level, 10.0).over(ground), far = air.air_along(level, 1e5).over(ground);
    CHECK(glm::length(near - ground) < glm::length(far - ground));
    CHECK(luminance(far) == doctest::Approx(luminance(air.sky(level))).epsilon(0.1));
}

TEST_CASE("metres in a surface unit set how blue distance is, and the altitude how thin the air") {
    scene::Scene scene = daylight_scene();
    const glm::dvec3 level{0.0, 0.0, 1.0};
    const float small = luminance(daylight_of(scene).air_along(level, 50.0).inscatter);
    scene.scale.metres = 1000.0;
    CHECK(luminance(daylight_of(scene).air_along(level, 50.0).inscatter) > 2.0f * small);
    scene = daylight_scene();
    scene.sky.altitude_m = 4000.0;
    CHECK(luminance(daylight_of(scene).air_along(level, 50.0).inscatter) < small);
}

TEST_CASE("white ground under a high sun is about 1, under a low sun red, and the sky's light grows with gain") {
    scene::Scene scene = daylight_scene();
    scene.sun.direction = {0.0, 1.0, 0.2};
    const glm::vec3 high = daylight_of(scene).sun_on_white(0.0);
    CHECK(luminance(high) > 0.7f);
    CHECK(luminance(high) < 1.8f);
    scene.sun.direction = {1.0, 0.05, 0.0};
    const glm::vec3 low = daylight_of(scene).sun_on_white(0.0);
    CHECK(low.r / low.b > 2.0f * high.r / high.b);
    const glm::vec3 open = daylight_of(scene).sky_on_white({0.0, 1.0, 0.0});
    scene.sky.gain = 2.0;
    const glm::vec3 filled = daylight_of(scene).sky_on_white({0.0, 1.0, 0.0});
    CHECK(luminance(filled) == doctest::Approx(2.0 * luminance(open)));
}

TEST_CASE("below the shadow's height there is no sun, above it all of it, and its edge follows a ridge line") {
    scene::Scene scene = daylight_scene();
    CHECK(daylight_of(scene).sun_over_ridges({3.0, -50.0, 2.0}) == 1.0f);  // none by default
    scene.sun.shadow_height = 1.0;
    CHECK(daylight_of(scene).sun_over_ridges({3.0, 0.9, 2.0}) == 0.0f);
    CHECK(daylight_of(scene).sun_over_ridges({3.0, 1.1, 2.0}) == 1.0f);
    CHECK(daylight_of(scene).sun_over_ridges({3.0, 1.0, 2.0}) == doctest::Approx(0.5));
    scene.sun.shadow_relief = 0.5;
    const DaylightScene uneven = daylight_of(scene);
    float least = 1.0f, most = 0.0f;
    for (int i = 0; i < 200; ++i) {
        const double t = 0.1 * i;
        const glm::dvec3 along = t * glm::dvec3(scene.sun.direction.z, 0.0, -scene.sun.direction.x);
        const float lit = uneven.sun_over_ridges(along + glm::dvec3(0.0, 1.0, 0.0));
        least = std::min(least, lit);
        most = std::max(most, lit);
        // Along the sun's direction the edge is level.
        const glm::dvec3 back = 5.0 * glm::dvec3(scene.sun.direction.x, 0.0, scene.sun.direction.z);
        CHECK(uneven.sun_over_ridges(along + back + glm::dvec3(0.0, 1.0, 0.0)) == doctest::Approx(lit).epsilon(1e-6));
    }
    CHECK(least == 0.0f);
    CHECK(most == 1.0f);
}

TEST_CASE("daylight over a planet or over ground that spins is refused") {
    scene::Scene scene = daylight_scene();
    CHECK_NOTHROW(scene::validate(scene, ""));
    scene.surface.kind = solid::kKind<solid::Sphere>;
    CHECK_THROWS_WITH_AS(scene::validate(scene, ""), doctest::Contains("sky.model"), scene::SceneError);
    scene = daylight_scene();
    scene.surface.spin_deg_per_s = 1.0;
    CHECK_THROWS_WITH_AS(scene::validate(scene, ""), doctest::Contains("spin"), scene::SceneError);
}

TEST_CASE("a picture in daylight is finite at every height of the sun") {
    for (const double elevation : {-0.1, 0.0, 0.01, 0.5, 1.0}) {
        scene::Scene scene = daylight_scene();
        scene.sun.direction = {std::sqrt(1.0 - elevation * elevation), elevation, 0.0};
        const auto image = integrate::make_image(scene, integrate::Tracer::fast);
        std::vector<double> u, v;
        for (int i = 0; i < 64; ++i) {
            u.push_back(scene.film.width * (i % 8 + 0.5) / 8.0);
            v.push_back(scene.film.height * (i / 8 + 0.5) / 8.0);
        }
        const std::vector<double> t(u.size(), 0.0);
        std::vector<glm::vec3> radiance(u.size());
        integrate::Counters counters;
        image->evaluate({u, v, t}, radiance, counters);
        for (const glm::vec3& c : radiance) {
            CHECK(std::isfinite(luminance(c)));
            CHECK(std::min({c.r, c.g, c.b}) >= 0.0f);
        }
    }
}
