// The light of a picture in layers: they add up to it.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "tests/support/builtins.h"

using namespace strata;

namespace {

// Layers and colour are sums of the same products in another order. With u = 2^-24, a sample's colour is
// (((R L) T1 + A1) T2 + A2) ... in float through M media, L being a sum of at most four terms: three additions, a
// product and, for each medium, a product and an addition are within (4 + 2 M) u of the exact value of terms that are
// not negative. A layer is ((R x) T1) T2 ..., x being a sum of at most two of these terms: within (2 + M) u; the
// media's own light is within 2 (M - 1) u, which is no more for M <= 4: air, fog, and clouds on both sides of it. Means
// in double by equal weights keep these shares, and each pixel of colour and layers is rounded once: 6 + 3 M + 2 units
// of the sum.
constexpr double kMostMedia = 4;
constexpr double kLayerError = (8 + 3 * kMostMedia) * 0x1p-24;

constexpr std::array kLayers{"sun", "sky", "bounce", "air", "background", "water"};

integrate::ChannelSet layers() {
    std::vector<const integrate::Channel*> channels;
    for (const char* name : kLayers) channels.push_back(integrate::find_channel(name));
    return integrate::ChannelSet(channels);
}

render::RenderResult small_render(scene::Scene scene, scene::EstimatorKind estimator) {
    scene.film.width = 36;
    scene.film.height = 20;
    scene.sampling.N = 2;
    scene.sampling.estimator = estimator;
    render::RenderOptions options;
    options.channels = layers();
    return render::render(*integrate::make_image(scene), estimate::Estimator(estimate::estimator_settings(scene)),
                          {0, 0, scene.film.width, scene.film.height}, options);
}

// The largest error in shares of kLayerError; `used` sums up each layer.
double largest_error(const film::Film& film, std::array<double, kLayers.size()>& used) {
    double worst = 0.0;
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0.0;
            for (std::size_t layer = 0; layer < kLayers.size(); ++layer) {
                const auto value = static_cast<double>(film.channels()[(i * kLayers.size() + layer) * 3 + c]);
                sum += value;
                used[layer] += value;
            }
            const auto colour = static_cast<double>(film.pixels()[i][static_cast<glm::length_t>(c)]);
            worst = std::max(worst, std::abs(sum - colour) / (kLayerError * std::max(sum, 1e-30)));
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("sun, sky, bounce, air, background and water add up to the picture, in every built-in scene") {
    std::array<double, kLayers.size()> used{};
    double largest = 0.0;
    for (const scene::BuiltinScene& builtin : support::builtins_to_render()) {
        CAPTURE(builtin.name);
        const scene::Scene scene = scene::read_scene(builtin.text, builtin.name);
        for (const auto estimator : {scene::EstimatorKind::stratified, scene::EstimatorKind::shared_sobol}) {
            const double error = largest_error(small_render(scene, estimator).film, used);
            CHECK(error <= 1.0);
            largest = std::max(largest, error);
        }
    }
    MESSAGE("largest error: " << largest << " of the bound, " << largest * kLayerError * 0x1p23 << " of 2^-23");
    for (const std::size_t layer : {0, 1, 3, 4, 5}) CHECK(used[layer] > 0.0);
}

TEST_CASE("layers of a scene without sun, sky or air are black, and the picture is the rest") {
    scene::Scene scene = scene::read_scene(scene::find_builtin("terrain")->text, "terrain");
    scene.sky.haze_distance = 0.0;
    scene.sun.intensity = 0.0;
    std::array<double, kLayers.size()> used{};
    CHECK(largest_error(small_render(scene, scene::EstimatorKind::stratified).film, used) <= 1.0);
    CHECK(used[0] == 0.0);
    CHECK(used[1] > 0.0);
    CHECK(used[2] == 0.0);
    CHECK(used[3] == 0.0);
    CHECK(used[4] > 0.0);
}

TEST_CASE("layers add up where a soft sun, sky rays and reflected light are in the picture") {
    for (const char* model : {"gradient", "daylight"}) {
        CAPTURE(model);
        scene::Scene scene = scene::read_scene(scene::find_builtin("terrain")->text, "terrain");
        scene.sky.model = model[0] == 'g' ? scene::SkyModel::gradient : scene::SkyModel::daylight;
        scene.sky.light = scene::SkyLight::rays;
        scene.sky.bounces = 2;
        scene.sun.angular_radius_deg = 3.0;
        std::array<double, kLayers.size()> used{};
        CHECK(largest_error(small_render(scene, scene::EstimatorKind::stratified).film, used) <= 1.0);
        for (const std::size_t layer : {0, 1, 2, 3, 4}) CHECK(used[layer] > 0.0);
    }
}

TEST_CASE("layers add up where fog is before the ground and the sky") {
    scene::Scene scene = scene::read_scene(scene::find_builtin("terrain")->text, "terrain");
    scene.scale.metres = 300.0;
    scene.fog = {.visibility_m = 3000.0, .level_m = 20.0, .fall_m = 60.0, .rise_m = 30.0, .patch_m = 900.0};
    for (const auto model : {scene::SkyModel::gradient, scene::SkyModel::daylight}) {
        scene.sky.model = model;
        std::array<double, kLayers.size()> used{}, clear{};
        CHECK(largest_error(small_render(scene, scene::EstimatorKind::stratified).film, used) <= 1.0);
        scene::Scene without = scene;
        without.fog.visibility_m = 0.0;
        CHECK(largest_error(small_render(without, scene::EstimatorKind::stratified).film, clear) <= 1.0);
        CHECK(used[3] > clear[3]);
        CHECK(used[4] < clear[4]);
    }
}

TEST_CASE("layers add up where the fog has shafts, which are the air's, and shadows make it darker") {
    scene::Scene scene = scene::read_scene(scene::find_builtin("terrain")->text, "terrain");
    scene.scale.metres = 300.0;
    scene.sun.direction = {-0.8, 0.04, 0.35};
    scene.fog = {.visibility_m = 3000.0, .level_m = 150.0, .fall_m = 120.0, .shafts = true};
    for (const auto model : {scene::SkyModel::gradient, scene::SkyModel::daylight}) {
        scene.sky.model = model;
        std::array<double, kLayers.size()> shadowed{}, lit{};
        CHECK(largest_error(small_render(scene, scene::EstimatorKind::stratified).film, shadowed) <= 1.0);
        scene::Scene open = scene;
        open.sun.shadows = false;
        CHECK(largest_error(small_render(open, scene::EstimatorKind::stratified).film, lit) <= 1.0);
        CHECK(shadowed[3] < 0.99 * lit[3]);
    }
}

TEST_CASE("layers add up where clouds are before ground and sky, from below and from above, with fog between") {
    scene::Scene scene = scene::read_scene(scene::find_builtin("terrain")->text, "terrain");
    scene.scale.metres = 300.0;
    scene.sky.model = scene::SkyModel::daylight;
    scene.sky.light = scene::SkyLight::rays;
    scene.fog = {.visibility_m = 30'000.0, .level_m = 20.0, .fall_m = 60.0, .rise_m = 30.0, .patch_m = 900.0};
    scene.clouds = {{.name = "low", .altitude_m = 500.0, .coverage = 0.6, .size_m = 900.0},
                    {.name = "high", .altitude_m = 3000.0, .depth = 1.0, .size_m = 4000.0}};
    for (const double up : {0.0, 4.0}) {
        scene.camera.position.y += up;
        std::array<double, kLayers.size()> used{};
        CHECK(largest_error(small_render(scene, scene::EstimatorKind::stratified).film, used) <= 1.0);
        for (const std::size_t layer : {0, 1, 2, 3}) CHECK(used[layer] > 0.0);
        CHECK((used[4] > 0.0) == (up == 0.0));  // from above no sky is seen
    }
}
