#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

#include "shaders_cpu/checker.h"
#include "shaders_cpu/constant.h"
#include "shaders_cpu/edge.h"
#include "shaders_cpu/ramp.h"
#include "shaders_cpu/wheel.h"
#include "shaders_cpu/zoneplate.h"
#include "src/integrate/pattern_image.h"

using namespace strata;

namespace {

struct Samples {
    std::vector<double> u, v, t;
    integrate::SampleBatch batch(std::size_t first, std::size_t count) const {
        return {std::span(u).subspan(first, count), std::span(v).subspan(first, count),
                std::span(t).subspan(first, count)};
    }
};

Samples random_samples(std::size_t count) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> unit;
    Samples samples;
    for (std::size_t i = 0; i < count; ++i) {
        samples.u.push_back(320 * unit(random));
        samples.v.push_back(200 * unit(random));
        samples.t.push_back(unit(random));
    }
    return samples;
}

scene::Scene make_scene(scene::ImageKind kind) {
    scene::Scene scene;
    scene.image = kind;
    scene.film.width = 320;
    scene.film.height = 200;
    scene.zoneplate.rings = 17.5;
    scene.checker.horizon = 0.4;
    scene.wheel.spokes = 7;
    return scene;
}

float pattern(const scene::Scene& scene, double u, double v, double t) {
    switch (scene.image) {
        case scene::ImageKind::zoneplate:
            return shaders::zoneplate(scene.zoneplate, 320, 200, u, v, t);
        case scene::ImageKind::checker:
            return shaders::checker(scene.checker, 320, 200, u, v, t);
        case scene::ImageKind::wheel:
            return shaders::wheel(scene.wheel, 320, 200, u, v, t);
        case scene::ImageKind::edge:
            return shaders::edge(scene.edge, 320, 200, u, v, t);
        case scene::ImageKind::ramp:
            return shaders::ramp(scene.ramp, 320, 200, u, v, t);
        case scene::ImageKind::constant:
            return shaders::constant(scene.constant, 320, 200, u, v, t);
        case scene::ImageKind::surface:
            break;
    }
    return -1.0f;
}

}  // namespace

TEST_CASE("a pattern image is the pattern at every sample, in grey, however the samples are batched") {
    constexpr std::size_t kCount = 1000;
    const Samples samples = random_samples(kCount);
    for (const auto kind : {scene::ImageKind::zoneplate, scene::ImageKind::checker, scene::ImageKind::wheel,
                            scene::ImageKind::edge, scene::ImageKind::ramp, scene::ImageKind::constant}) {
        const scene::Scene scene = make_scene(kind);
        const auto image = integrate::make_pattern_image(scene);
        integrate::Counters counters;
        std::vector<glm::vec3> whole(kCount);
        image->evaluate(samples.batch(0, kCount), whole, counters);
        CHECK(counters.noise_evaluations == 0);

        std::vector<glm::vec3> parts(kCount);
        for (std::size_t first = 0, size = 1; first < kCount; first += size, size = std::min(size + 13, kCount - first))
            image->evaluate(samples.batch(first, size), std::span(parts).subspan(first, size), counters);
        CHECK(parts == whole);

        int wrong = 0;
        for (std::size_t i = 0; i < kCount; ++i) {
            const double u = samples.u[i];
            const double v = samples.v[i];
            const double t = samples.t[i];
            wrong += whole[i] != glm::vec3(pattern(scene, u, v, t));
        }
        CHECK(wrong == 0);
        image->evaluate(samples.batch(0, 0), {}, counters);
    }
}

TEST_CASE("a surface is refused") {
    CHECK_THROWS_AS(integrate::make_pattern_image(make_scene(scene::ImageKind::surface)), std::invalid_argument);
}
