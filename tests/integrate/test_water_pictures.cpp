// Level water in pictures: mirror, shore, and what it leaves as it is.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "shaders_cpu/water_optics.h"
#include "src/scene/validate.h"
#include "tests/integrate/water_scenes.h"

using namespace strata;
using namespace strata::water_scenes;

TEST_CASE("calm water shows what a camera mirrored in it sees") {
    const scene::Scene scene = lake();
    scene::Scene mirrored = scene;
    mirrored.water.present = false;
    mirrored.camera.position.y = -mirrored.camera.position.y;
    mirrored.camera.look_at.y = -mirrored.camera.look_at.y;
    const Places places(scene);
    Places flipped = places;
    for (double& v : flipped.v) v = scene.film.height - v;
    const Channels seen = evaluate_all(scene, places.batch()), expected = evaluate_all(mirrored, flipped.batch());
    const glm::dvec3 eye = scene.camera.position;
    std::size_t of_water = 0, off = 0, of_ground = 0;
    for (std::size_t i = 0; i < places.u.size(); ++i) {
        const glm::dvec3 p(seen.at(i, "P"));
        if (!is_water(seen, i)) continue;
        ++of_water;
        of_ground += expected.at(i, "depth").x < 1e9f;
        const double reflected = shaders::fresnel(eye.y / glm::distance(p, eye));
        const glm::vec3 wanted = expected.radiance[i] * static_cast<float>(reflected);
        const glm::vec3 difference = glm::abs(seen.radiance[i] - wanted);
        off += std::max({difference.r, difference.g, difference.b}) > 0.01f * (0.01f + wanted.g);
    }
    MESSAGE("on water ", of_water, ", of these ground is mirrored in ", of_ground, ", off ", off);
    CHECK(of_water > 1000);
    CHECK(of_ground > 200);
    CHECK(off * 50 < of_water);  // at silhouettes and edges of shadows
}

// By looking for ground along each ray in small steps, in double, and at the point of the level.
TEST_CASE("the shore is where the ground is at the level: water where it is lower and nothing of it is before") {
    scene::Scene scene = lake();
    for (const bool is_near : {false, true}) {
        scene.camera.position = {1.0, 9.0, 2.0};
        scene.camera.look_at = {1.0, 0.0, is_near ? shore_of(scene, 1.0) : 8.9};
        if (is_near) scene.camera.fov_deg = 3.0;
        const Places places(scene);
        const Channels seen = evaluate_all(scene, places.batch());
        const SurfaceImage image(scene, Tracer::fast);
        const trace::Field& field = image.field();
        std::size_t doubtful = 0, water = 0;
        for (std::size_t i = 0; i < places.u.size(); ++i) {
            const trace::Ray ray = image.local_camera_ray(places.u[i], places.v[i], 0.0);
            const double way = (3.0 - ray.origin.y) / ray.direction.y;
            double least = 1e9;
            for (int k = 0; k <= 2000; ++k)
                least = std::min(least, field.value(ray.origin + way * k / 2000.0 * ray.direction));
            const double doubt = 4.0 * (ray.delta0 + ray.delta_slope * way) + (least < 0.0 ? 0.0 : 1e-4);
            if (std::abs(least) < doubt) {
                ++doubtful;
                continue;
            }
            water += least > 0.0;
            REQUIRE(is_water(seen, i) == (least > 0.0));
        }
        MESSAGE("water ", water, ", too near to tell ", doubtful);
        CHECK(water > 300);
        CHECK(water < 2700);
        CHECK(doubtful < 60);
    }
}

TEST_CASE(
    "ground over the water looks as it does without it, to the bit, and the light's layers are all of the light") {
    for (const double wind : {0.0, 4.0}) {
        scene::Scene scene = lake();
        scene.water.wind_m_s = wind;
        scene.water.absorption = {0.3, 0.1, 0.05};
        scene.water.deep = {0.0, 0.02, 0.03};
        scene.sky.haze_distance = 30.0;
        scene.sun.angular_radius_deg = 0.3;
        scene::Scene dry = scene;
        dry.water.present = false;
        const Places places(scene);
        Counters counters;
        const Channels seen = evaluate_all(scene, places.batch(), &counters),
                       without = evaluate_all(dry, places.batch());
        std::size_t water = 0;
        std::uint64_t steps = 0;
        for (std::size_t i = 0; i < places.u.size(); ++i) {
            glm::vec3 sum(0.0f);
            for (const char* layer : {"sun", "sky", "bounce", "water", "air", "background"}) sum += seen.at(i, layer);
            for (const int c : {0, 1, 2}) REQUIRE(sum[c] == doctest::Approx(seen.radiance[i][c]).epsilon(1e-5));
            steps += static_cast<std::uint64_t>(seen.at(i, "steps").x);
            if (is_water(seen, i)) {
                ++water;
                CHECK(seen.at(i, "water").g > 0.0f);
                CHECK(seen.at(i, "N").y > 0.5f);
            } else {
                REQUIRE(seen.radiance[i] == without.radiance[i]);
                REQUIRE(seen.at(i, "water") == glm::vec3(0.0f));
            }
        }
        CHECK(water > 500);
        CHECK(counters.water_rays == 2 * water);
        std::uint64_t in_phases = 0;
        for (const Phase phase : {Phase::beams, Phase::windows, Phase::sun_beams})
            in_phases += counters.phases[static_cast<std::size_t>(phase)].steps;
        CHECK(steps + in_phases <= counters.steps);
    }
}

TEST_CASE("a sample of water is its own: alone it has the same bits as among others") {
    scene::Scene scene = lake();
    scene.water.wind_m_s = 3.0;
    scene.sky.light = scene::SkyLight::rays;
    const Places places(scene, 300);
    const SurfaceImage image(scene, Tracer::fast);
    std::vector<glm::vec3> together(places.u.size());
    Counters counters;
    image.evaluate(places.batch(), together, counters);
    for (std::size_t i = 0; i < places.u.size(); ++i) {
        glm::vec3 alone(0.0f);
        image.evaluate({{&places.u[i], 1}, {&places.v[i], 1}, {&places.t[i], 1}}, std::span(&alone, 1), counters);
        REQUIRE(alone == together[i]);
    }
}

TEST_CASE("an eye that grazes, a calm and a stormy lake, a sun that is down: all is finite and no ray is unresolved") {
    for (const double wind : {0.0, 1e-6, 20.0}) {
        for (const glm::dvec3& sun :
             {glm::dvec3(0.0, 0.1, 1.0), glm::dvec3(0.0, -0.1, 1.0), glm::dvec3(0.0, 1e-9, 1.0)}) {
            scene::Scene scene = lake();
            scene.water.wind_m_s = wind;
            scene.water.absorption = {0.3, 0.1, 0.0};
            scene.camera.position = {0.0, 1e-3, 0.0};
            scene.camera.look_at = {0.0, 1e-3 - 6.0 * std::tan(0.01 * kPi / 180.0), 6.0};
            scene.camera.fov_deg = 0.05;
            scene.sun.direction = sun;
            const Places places(scene, 500);
            Counters counters;
            const Channels seen = evaluate_all(scene, places.batch(), &counters);
            for (const glm::vec3& c : seen.radiance) REQUIRE((std::isfinite(c.r) && std::isfinite(c.g) && c.g >= 0.0f));
            CHECK(counters.unresolved_rays == 0);
            CHECK(counters.water_rays > 200);
        }
    }
}

TEST_CASE("water that could not lie level, or an eye that is not over it, is refused by key and what is allowed") {
    const auto complaint = [](const scene::Scene& scene) {
        try {
            scene::validate(scene, "");
        } catch (const scene::SceneError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    scene::Scene scene = lake();
    CHECK(complaint(scene).empty());
    scene.camera.position.y = -0.1;
    CHECK(has(complaint(scene), "camera.position: is not above the water"));
    scene = lake();
    scene.surface.rotation_deg = {5.0, 0.0, 0.0};
    CHECK(has(complaint(scene), "surface.rotation_deg = [0, any, 0]"));
    scene = lake();
    scene.surface.spin_deg_per_s = 1.0;
    CHECK(has(complaint(scene), "surface.spin_deg_per_s = 0"));
    scene = basin(0.0);
    scene.surface.kind = solid::kKind<solid::Sphere>;
    CHECK(has(complaint(scene), "water.present: water lies level, a planet does not, allowed: false"));
}
