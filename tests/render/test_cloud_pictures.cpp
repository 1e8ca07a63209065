// Clouds in pictures: none leave every bit as it was; shadows are what the layer says; work does not decide bits.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "src/integrate/make_image.h"
#include "src/integrate/surface_image.h"
#include "src/integrate/surface_setup.h"
#include "src/render/render.h"
#include "src/scene/needs.h"

using namespace strata;

namespace {

scene::Scene hills_under_clouds() {
    scene::Scene scene;
    scene.film = {.width = 48, .height = 28};
    scene.sampling.N = 2;
    scene.surface.octaves = 4;
    scene.sky.model = scene::SkyModel::daylight;
    scene.scale.metres = 300.0;
    scene.camera.position = {0.0, 2.0, 0.0};
    scene.camera.look_at = {0.0, 1.9, 4.0};
    scene.clouds = {{.name = "layer", .altitude_m = 2000.0, .coverage = 0.6, .size_m = 900.0}};
    return scene;
}

render::RenderResult rendered(const scene::Scene& scene, const film::Rect& crop, const render::RenderOptions& options) {
    return render::render(*integrate::make_image(scene), estimate::Estimator(estimate::estimator_settings(scene)), crop,
                          options);
}

render::RenderResult rendered(const scene::Scene& scene) {
    return rendered(scene, {0, 0, scene.film.width, scene.film.height}, {});
}

bool are_equal(const film::Film& a, const film::Film& b) { return std::ranges::equal(a.pixels(), b.pixels()); }

}  // namespace

TEST_CASE("clouds of no depth or no coverage leave every bit as it is without them, and clouds change the picture") {
    for (const auto light : {scene::SkyLight::open, scene::SkyLight::rays}) {
        scene::Scene scene = hills_under_clouds();
        scene.sky.light = light;
        const auto cloudy = rendered(scene);
        scene.clouds.front().coverage = 0.0;
        const auto uncovered = rendered(scene);
        scene.clouds.front().coverage = 0.6;
        scene.clouds.front().depth = 0.0;
        const auto empty = rendered(scene);
        scene.clouds.clear();
        const auto none = rendered(scene);
        CHECK(are_equal(none.film, uncovered.film));
        CHECK(are_equal(none.film, empty.film));
        CHECK(!are_equal(none.film, cloudy.film));
    }
}

TEST_CASE(
    "clouds in the wind move from frame to frame, and blur while the shutter is open; the ground stays as it is") {
    scene::Scene scene = hills_under_clouds();
    const auto at_rest = rendered(scene);
    scene.clouds.front().wind_m_s = 15.0;
    scene.shutter.frame = 0;
    CHECK(scene::motion(scene).clouds);
    CHECK(!scene::needs_time_samples(scene));
    CHECK(are_equal(rendered(scene).film, at_rest.film));
    scene.shutter.frame = 1000;
    scene.clouds.front().wind_m_s = 0.0;
    const auto rests = rendered(scene);
    scene.clouds.front().wind_m_s = 15.0;
    const auto later = rendered(scene);
    CHECK(!are_equal(later.film, rests.film));
    scene.shutter.open_s = 30.0;
    CHECK(scene::needs_time_samples(scene));
    const auto blurred = rendered(scene);
    CHECK(!are_equal(blurred.film, later.film));
    for (const auto* picture : {&later, &blurred}) CHECK(picture->counters.rays == rests.counters.rays);
    CHECK(integrate::same_counts(later.counters, rests.counters));
}

TEST_CASE("clouds take no rays and no evaluations of the surface's noise") {
    scene::Scene scene = hills_under_clouds();
    const auto cloudy = rendered(scene);
    scene.clouds.clear();
    const auto none = rendered(scene);
    CHECK(cloudy.counters.steps == none.counters.steps);
    CHECK(cloudy.counters.noise_evaluations == none.counters.noise_evaluations);
    CHECK(cloudy.counters.shadow_rays == none.counters.shadow_rays);
}

TEST_CASE("a crop of a picture with clouds, in other tiles, has its bits, when something moves too") {
    for (const bool moves : {false, true}) {
        scene::Scene scene = hills_under_clouds();
        scene.sky.light = scene::SkyLight::rays;
        if (moves) {
            scene.shutter.open_s = 0.5;
            scene.camera.keys = {{.time_s = 0.0}, {.time_s = 1.0, .position = glm::dvec3(0.5, 8.0, 0.0)}};
        }
        const auto whole = rendered(scene);
        render::RenderOptions options;
        options.tile = 16;
        options.threads = 1;
        const film::Rect crop{9, 3, 41, 22};
        const auto part = rendered(scene, crop, options);
        for (int y = crop.y0; y < crop.y1; ++y) {
            for (int x = crop.x0; x < crop.x1; ++x) REQUIRE(part.film.at(x, y) == whole.film.at(x, y));
        }
    }
}

TEST_CASE("level ground under clouds has the sun's light less what the layer hides, sample by sample") {
    scene::Scene scene = hills_under_clouds();
    scene.surface.amplitude = 0.0;
    scene.sky.gain = 0.0;
    scene.camera.position = {0.0, 3.0, 0.0};
    scene.camera.look_at = {0.0, 0.0, 1.0};
    scene.sampling.estimator = scene::EstimatorKind::none;
    scene.material.low = scene.material.high = scene.material.steep = glm::dvec3(0.5);
    const auto sun = [](const scene::Scene& of) {
        const std::array<const integrate::Channel*, 2> channels{integrate::find_channel("sun"),
                                                                integrate::find_channel("P")};
        render::RenderOptions options;
        options.channels = integrate::ChannelSet(channels);
        return rendered(of, {0, 0, of.film.width, of.film.height}, options);
    };
    const auto cloudy = sun(scene);
    const integrate::SurfaceSetup setup(scene, integrate::Tracer::fast, 1000);
    scene.clouds.clear();
    const auto clear = sun(scene);
    const glm::dvec3 to_sun = glm::normalize(scene.sun.direction);
    double least = 1.0, most = 0.0;
    for (std::size_t i = 0; i < clear.film.pixels().size(); ++i) {
        const auto value = [&](const auto& result, std::size_t c) {
            return static_cast<double>(result.film.channels()[6 * i + c]);
        };
        if (value(clear, 1) == 0.0) continue;
        const glm::dvec3 x{value(clear, 3), 0.0, value(clear, 5)};
        const double share = value(cloudy, 1) / value(clear, 1);
        CHECK(share == doctest::Approx(setup.clouds->sunlight(x, to_sun)).epsilon(1e-3));
        least = std::min(least, share);
        most = std::max(most, share);
    }
    CHECK(least < 0.1);
    CHECK(most > 0.9);
}

TEST_CASE("the channel cloud is what is missing of the light behind") {
    scene::Scene scene = hills_under_clouds();
    scene.camera.look_at = {0.0, 3.0, 4.0};
    const std::array<const integrate::Channel*, 2> channels{integrate::find_channel("background"),
                                                            integrate::find_channel("cloud")};
    render::RenderOptions options;
    options.channels = integrate::ChannelSet(channels);
    scene.sampling.estimator = scene::EstimatorKind::none;
    const film::Rect all{0, 0, scene.film.width, scene.film.height};
    const auto cloudy = rendered(scene, all, options);
    scene.clouds.clear();
    const auto clear = rendered(scene, all, options);
    double most = 0.0;
    for (std::size_t i = 0; i < clear.film.pixels().size(); ++i) {
        const double before = static_cast<double>(clear.film.channels()[4 * i + 1]);
        const double behind = static_cast<double>(cloudy.film.channels()[4 * i + 1]);
        const double hidden = static_cast<double>(cloudy.film.channels()[4 * i + 3]);
        CHECK(clear.film.channels()[4 * i + 3] == 0.0f);
        if (before > 0.0) CHECK(behind == doctest::Approx(before * (1.0 - hidden)).epsilon(1e-4));
        most = std::max(most, hidden);
    }
    CHECK(most > 0.5);
}
