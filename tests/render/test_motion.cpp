// Cameras that follow keys and noise that drifts, as pictures: blur is the average of instants, an instant is a still.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
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

constexpr int kWidth = 24, kHeight = 14;
constexpr double kPixels = kWidth * kHeight;

scene::Scene base_scene(solid::Kind kind) {
    scene::Scene scene = support::small_scene(kind, kWidth, kHeight);
    scene.sampling = {.estimator = scene::EstimatorKind::random, .m = 1};
    scene.surface.octaves = 4;
    scene.sky.haze_distance = 20.0;
    return scene;
}

RenderResult render_scene(const scene::Scene& scene) {
    return render::render(*make_image(scene), Estimator(estimator_settings(scene)), {0, 0, kWidth, kHeight});
}

bool same_bits(const Film& a, const Film& b) {
    return std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(glm::vec3)) == 0;
}

double mean_squared_difference(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 apart(a[i] - b[i]);
        sum += glm::dot(apart, apart) / (3.0 * static_cast<double>(a.size()));
    }
    return sum;
}

// Of each pixel: the variance of one sample over position and time, averaged over channels.
std::vector<double> sample_variances(const scene::Scene& scene) {
    const auto image = make_image(scene);
    const Estimator estimator(estimator_settings(scene));
    std::vector<double> variances;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const glm::ivec2 pixel(x, y);
            SampleSet samples;
            estimator.pixel_samples({&pixel, 1}, samples);
            std::vector<glm::vec3> radiance(samples.u.size());
            Counters counters;
            image->evaluate(samples.batch(0, radiance.size()), radiance, counters);
            glm::dvec3 mean(0.0), squares(0.0);
            for (const glm::vec3& value : radiance) {
                mean += glm::dvec3(value) / static_cast<double>(radiance.size());
                squares += glm::dvec3(value) * glm::dvec3(value) / static_cast<double>(radiance.size());
            }
            const glm::dvec3 variance = squares - mean * mean;
            variances.push_back((variance.x + variance.y + variance.z) / 3.0);
        }
    }
    return variances;
}

// The same with a camera that goes 8 degrees to the right and forwards while the shutter is open.
scene::Scene with_pan(scene::Scene scene, double open_s) {
    const glm::dvec3 to = scene.camera.look_at, from = scene.camera.position;
    const glm::dvec3 side = 0.14 * glm::length(to - from) * glm::normalize(glm::cross(to - from, scene.camera.up));
    scene.camera.keys = {{.time_s = 0.0, .position = from, .look_at = to},
                         {.time_s = 0.5 * open_s, .look_at = to + 0.3 * side, .fov_deg = 55.0},
                         {.time_s = open_s, .position = from + 0.05 * (to - from), .look_at = to + side}};
    return scene;
}

// The picture with an open shutter against the average of instants: both are unbiased estimates of one integral, with
// independent samples, but for the instants' midpoint rule in time. With n and n' samples a pixel the expected squared
// difference is v (1/n + 1/n') at most, v a sample's variance: strata in time only lower it. Its mean over pixels,
// whose errors are independent and nearly normal, has the variance of a sum of squares: 2 v^2 (1/n + 1/n')^2 a pixel.
void check_blur(scene::Scene scene) {
    constexpr int kInstants = 48, kInstantSide = 3, kBlurSide = 20;
    scene.shutter = {.fps = 25.0, .open_s = 0.4, .frame = 0};
    scene.sampling.N = kBlurSide;
    const Film blurred = render_scene(scene).film;
    const std::vector<double> variances = sample_variances(scene);

    std::vector<glm::vec3> average(blurred.pixels().size(), glm::vec3(0.0f));
    Film middle;
    for (int i = 0; i < kInstants; ++i) {
        scene::Scene instant = scene;
        const double t = 0.4 * (i + 0.5) / kInstants;
        instant.shutter = {.fps = 1.0 / t, .open_s = 0.0, .frame = 1};
        instant.sampling.N = kInstantSide;
        instant.sampling.seed = 1000 + static_cast<std::uint64_t>(i);
        const Film film = render_scene(instant).film;
        for (std::size_t p = 0; p < average.size(); ++p) average[p] += film.pixels()[p] / float{kInstants};
        if (i == kInstants / 2) middle = film;
    }
    constexpr double kShare = 1.0 / (kBlurSide * kBlurSide) + 1.0 / (kInstants * kInstantSide * kInstantSide);
    double expected = 0.0, spread = 0.0;
    for (const double variance : variances) {
        expected += kShare * variance / kPixels;
        spread += 2.0 * std::pow(kShare * variance / kPixels, 2);
    }
    spread = std::sqrt(spread);
    const double found = mean_squared_difference(blurred.pixels(), average);
    MESSAGE("mean squared difference " << found << ", " << found / expected << " of the expected, of which "
                                       << 5.0 * spread / expected << " is allowed beyond; "
                                       << mean_squared_difference(blurred.pixels(), middle.pixels()) / expected
                                       << " to the instant in the middle");
    CHECK(found < expected + 5.0 * spread);
    CHECK(mean_squared_difference(blurred.pixels(), middle.pixels()) > 4.0 * found);
}

}  // namespace

TEST_CASE("a camera pan through an open shutter is the average of its instants") {
    check_blur(with_pan(base_scene(solid::kKind<solid::DisplacedPlane>), 0.4));
    check_blur(with_pan(base_scene(solid::kKind<solid::LevelSet>), 0.4));
}

TEST_CASE("noise that drifts through an open shutter, spinning and seen by a moving camera, averages its instants") {
    scene::Scene scene = with_pan(base_scene(solid::kKind<solid::LevelSet>), 0.4);
    scene.surface.drift = {0.8, 0.3, -0.5};
    scene.surface.spin_deg_per_s = 60.0;
    check_blur(scene);
    scene = base_scene(solid::kKind<solid::HeightField>);
    scene.surface.drift = {0.5, 0.0, 1.5};
    check_blur(scene);
}

TEST_CASE("with the shutter an instant, a camera on keys is a still camera, to the bit") {
    for (const auto interpolation : {scene::Interpolation::smooth, scene::Interpolation::linear}) {
        scene::Scene moving = with_pan(base_scene(solid::kKind<solid::DisplacedPlane>), 0.4);
        moving.camera.interpolation = interpolation;
        moving.shutter = {.fps = 25.0, .open_s = 0.0, .frame = 5};
        // A key in the middle, at 0.2 s, is frame 5.
        scene::Scene still = moving;
        still.camera.look_at = *moving.camera.keys[1].look_at;
        still.camera.fov_deg = *moving.camera.keys[1].fov_deg;
        still.camera.keys.clear();
        const RenderResult expected = render_scene(still), found = render_scene(moving);
        CHECK(same_bits(expected.film, found.film));
        CHECK(expected.counters.noise_evaluations == found.counters.noise_evaluations);
        moving.shutter.frame = 4;
        CHECK(!same_bits(expected.film, render_scene(moving).film));
    }
}

TEST_CASE("terrain that drifts along its plane is the same terrain seen from a place drifted the other way") {
    for (const solid::Kind kind : {solid::kKind<solid::HeightField>, solid::kKind<solid::DisplacedPlane>}) {
        scene::Scene scene = base_scene(kind);
        scene.shutter = {.fps = 25.0, .open_s = 0.0, .frame = 50};  // 2 s
        scene::Scene elsewhere = scene;
        scene.surface.drift = {1.5, 0.0, -2.25};
        elsewhere.camera.position += glm::dvec3(-3.0, 0.0, 4.5);
        elsewhere.camera.look_at += glm::dvec3(-3.0, 0.0, 4.5);
        const RenderResult drifted = render_scene(scene), moved = render_scene(elsewhere);
        // Steps, and so where within the tolerance the gradients are taken, differ by rounding.
        CHECK(mean_squared_difference(drifted.film.pixels(), moved.film.pixels()) < 1e-5);
        CHECK(drifted.counters.rays == moved.counters.rays);
        scene.shutter.frame = 0;
        elsewhere = scene;
        elsewhere.surface.drift = glm::dvec3(0.0);
        CHECK(same_bits(render_scene(scene).film, render_scene(elsewhere).film));
    }
}

TEST_CASE("an isosurface whose noise drifts morphs within its bound") {
    scene::Scene scene = base_scene(solid::kKind<solid::LevelSet>);
    scene.surface.shape<solid::LevelSet>().threshold = -10.0;  // solid throughout: the ball itself
    scene.surface.drift = {0.0, 0.5, 0.0};
    scene.sampling.seed = 3;
    const auto silhouette = [&](double threshold, int frame) {
        scene.surface.shape<solid::LevelSet>().threshold = threshold;
        scene.shutter = {.fps = 25.0, .open_s = 0.0, .frame = frame};
        scene.sampling.estimator = scene::EstimatorKind::none;  // the same rays at any time
        return render_scene(scene);
    };
    CHECK(same_bits(silhouette(-10.0, 0).film, silhouette(-10.0, 30).film));
    const RenderResult start = silhouette(0.0, 0), later = silhouette(0.0, 30);
    CHECK(mean_squared_difference(start.film.pixels(), later.film.pixels()) > 1e-3);
    CHECK(later.counters.hits <= silhouette(-10.0, 0).counters.hits);
    CHECK(later.counters.hits > 0);
}
