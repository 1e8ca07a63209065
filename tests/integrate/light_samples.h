// Scenes seen from above, and many samples of few places of them, each with random dimensions of its own.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "src/integrate/surface_image.h"

namespace strata::light_samples {

using namespace strata::integrate;

inline constexpr double kPi = std::numbers::pi;

// Seen from above: every sample hits.
inline scene::Scene scene_from_above(double amplitude) {
    scene::Scene scene;
    scene.film = {.width = 16, .height = 16};
    scene.surface.amplitude = amplitude;
    scene.surface.octaves = 3;
    scene.surface.frequency = 0.4;
    scene.camera.position = {0.3, 8.0, 0.2};
    scene.camera.look_at = {0.3, 0.0, 0.2};
    scene.camera.up = {0.0, 0.0, 1.0};
    scene.camera.far = 1000.0;
    scene.sampling.tolerance = 1e-4;  // pixels are wide here
    scene.sun.intensity = 0.0;
    scene.sky.light = scene::SkyLight::rays;
    scene.material.low = scene.material.high = scene.material.steep = glm::dvec3(0.5);
    return scene;
}

inline void make_furnace(scene::Scene& scene, double radiance) {
    scene.sky.zenith = scene.sky.horizon = glm::dvec3(radiance);
    scene.material.low = scene.material.high = scene.material.steep = glm::dvec3(1.0);
}

// n samples a pixel, all at one place in each pixel of the diagonal.
struct Samples {
    std::vector<double> u, v, t;
    std::vector<std::uint64_t> keys;
    std::uint32_t n;

    Samples(int pixels, std::uint32_t samples_each, std::uint64_t seed = 1) : n(samples_each) {
        for (int p = 0; p < pixels; ++p) {
            keys.push_back(sample::cell_key(seed, p, p));
            for (std::uint32_t i = 0; i < n; ++i) {
                u.push_back(16.0 * (p + 0.5) / pixels);
                v.push_back(16.0 * (p + 0.5) / pixels);
                t.push_back(0.0);
            }
        }
    }
    SampleBatch batch() const { return {u, v, t, {keys, n, 0}}; }
};

inline std::vector<glm::vec3> evaluate(const scene::Scene& scene, const Samples& samples, Counters* counters = nullptr,
                                       Tracer tracer = Tracer::fast) {
    std::vector<glm::vec3> radiance(samples.u.size());
    Counters counted;
    SurfaceImage(scene, tracer).evaluate(samples.batch(), radiance, counters != nullptr ? *counters : counted);
    return radiance;
}

struct Mean {
    double value = 0.0, error = 0.0;  // of the mean: standard deviation, from the means of pixels' samples
};

// Of equal places with ids of their own: each pixel's mean is one independent number.
inline Mean mean_of(const std::vector<glm::vec3>& radiance, std::uint32_t n, int channel = 1) {
    const std::size_t groups = radiance.size() / n;
    double sum = 0.0, sum2 = 0.0;
    for (std::size_t g = 0; g < groups; ++g) {
        double mean = 0.0;
        for (std::size_t i = 0; i < n; ++i) mean += static_cast<double>(radiance[g * n + i][channel]) / n;
        sum += mean;
        sum2 += mean * mean;
    }
    const double count = static_cast<double>(groups), mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, sum2 / count - mean * mean) / (count - 1.0))};
}

// As many groups of n samples at one place of the screen.
inline Samples at_one_place(int groups, std::uint32_t n, double u, double v) {
    Samples samples(groups, n);
    std::ranges::fill(samples.u, u);
    std::ranges::fill(samples.v, v);
    return samples;
}

}  // namespace strata::light_samples
