// Shadows in the fog against the integral along the ray, by another tracer and by formulas of their own.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "src/integrate/make_image.h"
#include "src/integrate/surface_image.h"
#include "src/render/render.h"
#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "src/trace/reference_tracer.h"

using namespace strata;
using namespace strata::integrate;

namespace {

// Steep ground under a low sun, half of it in fog.
scene::Scene hills(bool has_shafts) {
    scene::Scene scene = scene::read_scene(scene::find_builtin("terrain")->text, "terrain");
    scene.film.width = 36;
    scene.film.height = 20;
    scene.surface.octaves = 5;
    scene.scale.metres = 300.0;
    scene.sky.haze_distance = 0.0;
    scene.sun.direction = {-0.8, 0.04, 0.35};
    scene.fog = {.visibility_m = 4000.0, .level_m = 150.0, .fall_m = 120.0, .forward = 0.5, .shafts = has_shafts};
    scene.sampling.tolerance = 0.01;
    scene::validate(scene);
    return scene;
}

struct Mean {
    glm::dvec3 value{0.0}, variance{0.0};  // of the mean
};

// The channel "air" of one ray, by `count` samples that differ in their random numbers alone: nothing moves.
Mean air_of(const scene::Scene& scene, double u, double v, std::size_t count) {
    const std::vector<double> us(count, u), vs(count, v);
    std::vector<double> ts(count);
    for (std::size_t i = 0; i < count; ++i) ts[i] = 1e-6 * static_cast<double>(i);
    const std::array asked{find_channel("air")};
    const ChannelSet channels(asked);
    std::vector<glm::vec3> radiance(count);
    std::vector<float> values(3 * count);
    Counters counters;
    make_image(scene)->evaluate({us, vs, ts}, {radiance, channels, values}, counters);
    glm::dvec3 sum(0.0), squares(0.0);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 value(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
        sum += value;
        squares += value * value;
    }
    const auto n = static_cast<double>(count);
    return {sum / n, glm::max(squares / n - sum * sum / (n * n), 0.0) / (n - 1.0)};
}

// Sunlight that reaches the eye from a way through even fog: the sum over `pieces` of what each scatters if the sun is
// seen from its middle, by the reference tracer; extinction, transmittance and phase by their definitions.
glm::dvec3 sunlight_in_fog(const scene::Scene& scene, double u, double v, int pieces) {
    const SurfaceImage image(scene, Tracer::fast);
    const trace::Ray ray = image.camera_ray(u, v, 0.0);
    const trace::Field field(scene.surface);
    const trace::Hit hit = trace::trace_reference(field, ray);
    const scene::Fog& fog = scene.fog;
    const glm::dvec3 to_sun = glm::normalize(scene.sun.direction);
    const double metres = scene.scale.metres, climb = ray.direction.y, y = ray.origin.y * metres;
    const double end = std::min(hit.state == trace::HitState::hit ? hit.s * metres : 1e300, 100e3);
    const double thickest = 3.912 / fog.visibility_m;
    const auto depth_at = [&](double s) {
        const double slope = climb / fog.fall_m, here = thickest * std::exp(-(y - fog.level_m) / fog.fall_m);
        return here * (1.0 - std::exp(-slope * s)) / slope;
    };
    const double g = fog.forward, cosine = glm::dot(ray.direction, to_sun);
    const double phase = (1.0 - g * g) / (4.0 * std::numbers::pi * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
    double seen = 0.0;
    for (int i = 0; i < pieces; ++i) {
        // Shorter where the fog is near the eye.
        const auto at = [&](double share) { return end * share * share; };
        const double from = at(i / (1.0 * pieces)), to = at((i + 1.0) / pieces), middle = at((i + 0.5) / pieces);
        trace::Ray shadow = ray;
        shadow.origin += middle / metres * ray.direction;
        shadow.direction = to_sun;
        const bool is_lit = trace::trace_reference(field, shadow).state == trace::HitState::miss;
        if (is_lit) seen += std::exp(-depth_at(from)) - std::exp(-depth_at(to));
    }
    return seen * phase * scene.sun.intensity * scene.sun.colour;
}

scene::Scene without_sun(scene::Scene scene) {
    scene.sun.intensity = 0.0;
    return scene;
}

render::RenderResult render_with(const scene::Scene& scene, const char* channel, scene::EstimatorKind estimator) {
    scene::Scene small = scene;
    small.sampling.N = 2;
    small.sampling.estimator = estimator;
    render::RenderOptions options;
    options.threads = 1;
    const std::array asked{find_channel(channel), find_channel("evals")};
    options.channels = ChannelSet(asked);
    return render::render(*make_image(small), estimate::Estimator(estimate::estimator_settings(small)),
                          {0, 0, small.film.width, small.film.height}, options);
}

}  // namespace

TEST_CASE("the mean over samples is the integral over many points of the ray, in and out of shadows") {
    constexpr std::size_t kSamples = 20'000;
    constexpr int kPieces = 20'000;
    const scene::Scene scene = hills(true);
    int half_shadowed = 0;
    for (const auto& [u, v] :
         {std::pair(6.3, 4.2), std::pair(18.1, 9.3), std::pair(25.4, 17.1), std::pair(22.2, 15.3),
          std::pair(28.6, 18.4), std::pair(19.7, 16.9), std::pair(33.0, 11.7), std::pair(12.8, 18.1)}) {
        CAPTURE(u);
        const Mean with = air_of(scene, u, v, kSamples), sky = air_of(without_sun(scene), u, v, 1);
        const glm::dvec3 expected = sunlight_in_fog(scene, u, v, kPieces);
        scene::Scene bright = scene;
        bright.sun.shadows = false;
        const glm::dvec3 lit = air_of(bright, u, v, 1).value - sky.value;
        half_shadowed += expected.r > 0.1 * lit.r && expected.r < 0.9 * lit.r;
        for (int c = 0; c < 3; ++c) {
            // An edge of a shadow within a piece is off by as much as the piece scatters.
            const double of_pieces = 4.0 * lit[c] / kPieces;
            const double off = std::abs(with.value[c] - sky.value[c] - expected[c]);
            CHECK(off <= 4.0 * std::sqrt(with.variance[c]) + of_pieces + 1e-6 * lit[c]);
        }
    }
    CHECK(half_shadowed >= 2);
}

TEST_CASE("where nothing hides the sun, fog with shafts looks as fog without, and has no noise") {
    for (const auto model : {scene::SkyModel::gradient, scene::SkyModel::daylight}) {
        scene::Scene with = hills(true), without = hills(false);
        for (scene::Scene* scene : {&with, &without}) {
            scene->sky.model = model;
            scene->sun.shadows = false;
        }
        // In daylight the sun's colour at the place itself counts, not that at the fog's level, and the air before it.
        const double tolerance = model == scene::SkyModel::gradient ? 1e-5 : 0.2;
        const auto a = render_with(with, "air", scene::EstimatorKind::stratified);
        const auto b = render_with(without, "air", scene::EstimatorKind::stratified);
        double worst = 0.0;
        for (std::size_t i = 0; i < a.film.pixels().size(); ++i)
            for (int c = 0; c < 3; ++c)
                worst =
                    std::max(worst, std::abs(static_cast<double>(a.film.pixels()[i][c]) / b.film.pixels()[i][c] - 1.0));
        MESSAGE("largest relative difference " << worst);
        CHECK(worst < tolerance);
        CHECK(a.counters.shadow_rays == 0);
    }
}

TEST_CASE("a shadow ray a sample is what shafts cost, and its steps and evaluations are told") {
    const auto plain = render_with(hills(false), "steps", scene::EstimatorKind::stratified);
    const auto shafts = render_with(hills(true), "steps", scene::EstimatorKind::stratified);
    // Rays that the fog scatters no light along need none.
    CHECK(shafts.counters.shadow_rays > plain.counters.shadow_rays + 9 * shafts.counters.rays / 10);
    CHECK(shafts.counters.shadow_rays <= plain.counters.shadow_rays + shafts.counters.rays);
    glm::dvec2 told(0.0), counted(shafts.counters.steps, shafts.counters.noise_evaluations);
    for (std::size_t i = 0; i < shafts.film.channels().size(); i += 2)
        told += 4.0 * glm::dvec2(shafts.film.channels()[i], shafts.film.channels()[i + 1]);
    for (const Phase shared : {Phase::beams, Phase::windows, Phase::sun_beams}) {
        const PhaseCost& cost = shafts.counters.phases[static_cast<std::size_t>(shared)];
        counted -= glm::dvec2(cost.steps, cost.noise_evaluations);
    }
    CHECK(told == counted);
}

TEST_CASE("shafts without fog change no bit and cost nothing") {
    scene::Scene clear = hills(false);
    clear.fog.visibility_m = 0.0;
    scene::Scene asked = clear;
    asked.fog.shafts = true;
    for (const auto estimator : {scene::EstimatorKind::stratified, scene::EstimatorKind::shared_sobol}) {
        const auto a = render_with(clear, "air", estimator), b = render_with(asked, "air", estimator);
        CHECK(a.film.pixels() == b.film.pixels());
        CHECK(same_counts(a.counters, b.counters));
    }
}
