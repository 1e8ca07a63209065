// The picture of a surface: what it counts, what time does to it, and that it goes along with whatever carries surface,
// camera and sun together.
#include "src/integrate/surface_image.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "tests/support/surfaces.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::render;

namespace {

constexpr int kWidth = 48, kHeight = 27;

scene::Scene small_scene(solid::Kind kind) {
    scene::Scene scene = support::small_scene(kind, kWidth, kHeight);
    scene.sampling.estimator = scene::EstimatorKind::stratified;
    scene.surface.octaves = 6;
    return scene;
}

RenderResult render_scene(const scene::Scene& scene) {
    const auto image = make_image(scene);
    return render::render(*image, Estimator(estimator_settings(scene)), {0, 0, scene.film.width, scene.film.height});
}

bool same_bits(const Film& a, const Film& b) {
    return a.pixels().size() == b.pixels().size() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(glm::vec3)) == 0;
}

struct Difference {
    double mean = 0.0, max = 0.0;
};

Difference difference(const Film& a, const Film& b) {
    Difference result;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const glm::vec3 apart = glm::abs(a.pixels()[i] - b.pixels()[i]);
        const double worst = std::max({apart.x, apart.y, apart.z});
        result.mean += worst / static_cast<double>(a.pixels().size());
        result.max = std::max(result.max, worst);
    }
    return result;
}

}  // namespace

TEST_CASE("N * N rays a pixel, and shadow rays only where there is a sun that casts shadows") {
    for (const solid::Kind kind : support::all_kinds()) {
        scene::Scene scene = small_scene(kind);
        const RenderResult shadowed = render_scene(scene);
        CHECK(shadowed.counters.rays == 4u * kWidth * kHeight);
        CHECK(shadowed.counters.shadow_rays > 0);
        CHECK(shadowed.counters.shadow_rays <= shadowed.counters.hits);
        CHECK(shadowed.counters.hits <= shadowed.counters.rays);
        CHECK(shadowed.counters.unresolved_rays == 0);
        scene.sun.shadows = false;
        const RenderResult lit = render_scene(scene);
        CHECK(lit.counters.shadow_rays == 0);
        CHECK(lit.counters.hits == shadowed.counters.hits);
        CHECK(lit.counters.noise_evaluations < shadowed.counters.noise_evaluations);
        for (std::size_t i = 0; i < lit.film.pixels().size(); ++i) {
            REQUIRE(glm::all(glm::lessThanEqual(shadowed.film.pixels()[i], lit.film.pixels()[i] + 1e-6f)));
        }
        scene.sun.shadows = true;
        scene.sun.intensity = 0.0;
        const RenderResult dark = render_scene(scene);
        CHECK(dark.counters.shadow_rays == 0);
        CHECK(dark.counters.noise_evaluations == lit.counters.noise_evaluations);
    }
}

TEST_CASE("a closed shutter shows a spinning planet as the still of its frame's time, an open one blurs it") {
    scene::Scene moving = small_scene(solid::kKind<solid::Sphere>);
    moving.surface.spin_deg_per_s = 90.0;
    moving.surface.amplitude = 0.3;
    moving.shutter = {.fps = 2.0, .open_s = 0.0, .frame = 6};  // 3 s: 270 degrees
    scene::Scene still = moving;
    still.surface.spin_deg_per_s = 0.0;
    still.surface.rotation_deg = {0.0, 270.0, 0.0};
    const Film instant = render_scene(moving).film;
    CHECK(same_bits(instant, render_scene(still).film));
    moving.shutter.frame = 4;
    CHECK(difference(instant, render_scene(moving).film).mean > 1e-3);
    moving.shutter.frame = 6;
    moving.shutter.open_s = 0.2;
    const RenderResult blurred = render_scene(moving);
    CHECK(difference(instant, blurred.film).mean > 1e-3);
    CHECK(blurred.counters.rays == 4u * kWidth * kHeight);
    // Without motion the shutter makes no difference.
    still.shutter.open_s = 0.2;
    CHECK(same_bits(instant, render_scene(still).film));
}

TEST_CASE("the reference tracer gives the same picture but for silhouettes") {
    for (const solid::Kind kind : support::all_kinds()) {
        scene::Scene scene = small_scene(kind);
        scene.film = {.width = 24, .height = 14};
        scene.surface.octaves = 3;
        scene.sampling.N = 1;
        const Estimator estimator(estimator_settings(scene));
        const Rect frame{0, 0, 24, 14};
        const RenderResult fast = render::render(*make_image(scene, Tracer::fast), estimator, frame);
        const RenderResult reference = render::render(*make_image(scene, Tracer::reference), estimator, frame);
        const Difference apart = difference(fast.film, reference.film);
        MESSAGE("kind " << static_cast<int>(kind) << ": mean difference " << apart.mean << ", largest " << apart.max);
        CHECK(apart.mean < 0.01);
        CHECK(fast.counters.rays == reference.counters.rays);
    }
}

namespace {

// Bounds of the difference from one picture to the same one carried elsewhere: single samples at silhouettes and shadow
// edges may fall on the other side.
void check_same_picture(const std::string& what, solid::Kind kind, const Film& expected, const scene::Scene& moved) {
    const Difference apart = difference(expected, render_scene(moved).film);
    MESSAGE("kind " << static_cast<int>(kind) << ", " << what << ": mean difference " << apart.mean << ", largest "
                    << apart.max);
    CHECK(apart.mean < 1e-3);
}

glm::dvec3 turn_about_y(const glm::dvec3& x, double degrees) {
    const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    return {c * x.x + s * x.z, x.y, -s * x.x + c * x.z};
}

glm::dvec3 turn_about_x(const glm::dvec3& x, double degrees) {
    const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    return {x.x, c * x.y - s * x.z, s * x.y + c * x.z};
}

template <class Turn>
scene::Scene turned(scene::Scene scene, const Turn& turn, const glm::dvec3& rotation_deg) {
    scene.camera.position = turn(scene.camera.position);
    scene.camera.look_at = turn(scene.camera.look_at);
    scene.camera.up = turn(scene.camera.up);
    scene.sun.direction = turn(scene.sun.direction);
    scene.surface.rotation_deg = rotation_deg;
    return scene;
}

}  // namespace

namespace {

scene::Scene moved_by(scene::Scene scene, const glm::dvec3& offset) {
    scene.camera.position += offset;
    scene.camera.look_at += offset;
    scene.surface.origin += offset;
    return scene;
}

}  // namespace

TEST_CASE("surface and camera moved together: the same picture, to the bit by whole numbers") {
    for (const solid::Kind kind : support::all_kinds()) {
        const scene::Scene scene = small_scene(kind);
        // On a coarse grid, so that whole offsets add without rounding.
        scene::Scene grid = scene;
        grid.camera.position = glm::round(scene.camera.position * 64.0) / 64.0;
        grid.camera.look_at = glm::round(scene.camera.look_at * 64.0) / 64.0;
        CHECK(same_bits(render_scene(moved_by(grid, {1000, -70, 123456789})).film, render_scene(grid).film));
        const Film expected = render_scene(scene).film;
        for (const glm::dvec3& offset : {glm::dvec3(0.1, 7.3, -0.77), glm::dvec3(1e8 / 7.0, -1e6 / 3.0, 1e7 / 11.0)}) {
            check_same_picture("moved", kind, expected, moved_by(scene, offset));
        }
    }
}

TEST_CASE("surface, camera and distances scaled together: the same picture, to the bit by powers of two") {
    for (const solid::Kind kind : support::all_kinds()) {
        const scene::Scene scene = small_scene(kind);
        const Film expected = render_scene(scene).film;
        for (const double scale : {0x1p-20, 0.5, 64.0, 0x1p20, 3.7, 1e-5}) {
            scene::Scene scaled = scene;
            scaled.camera.position *= scale;
            scaled.camera.look_at *= scale;
            scaled.camera.far *= scale;
            scaled.surface.scale *= scale;
            if (std::exp2(std::round(std::log2(scale))) == scale) {
                CHECK(same_bits(render_scene(scaled).film, expected));
            } else {
                check_same_picture("scaled", kind, expected, scaled);
            }
        }
    }
}

TEST_CASE("surface, camera and sun turned together: the same picture") {
    for (const solid::Kind kind : support::all_kinds()) {
        const scene::Scene scene = small_scene(kind);
        const Film expected = render_scene(scene).film;
        for (const double degrees : {90.0, 17.0}) {
            const auto about_y = [&](const glm::dvec3& x) { return turn_about_y(x, degrees); };
            check_same_picture("turned about y", kind, expected, turned(scene, about_y, {0.0, degrees, 0.0}));
            const auto about_x = [&](const glm::dvec3& x) { return turn_about_x(x, degrees); };
            check_same_picture("turned about x", kind, expected, turned(scene, about_x, {degrees, 0.0, 0.0}));
        }
    }
}

TEST_CASE("a ray given up at the step limit is counted and drawn in its own colour") {
    scene::Scene scene;
    scene.camera = {.position = {0.0, 1.0, 0.0}, .look_at = {0.0, 0.5, 1.0}};
    scene.film = {.width = 8, .height = 8};
    const std::vector<double> u = {4.0}, v = {5.0}, t = {0.0};
    std::vector<glm::vec3> radiance(1);
    integrate::Counters counters;
    integrate::SurfaceImage(scene, integrate::Tracer::fast, 2).evaluate({u, v, t}, radiance, counters);
    CHECK(counters.unresolved_rays == 1);
    CHECK(radiance[0] == integrate::kUnresolvedRadiance);
    counters = {};
    integrate::SurfaceImage(scene, integrate::Tracer::fast).evaluate({u, v, t}, radiance, counters);
    CHECK(counters.unresolved_rays == 0);
    CHECK(radiance[0] != integrate::kUnresolvedRadiance);
}
