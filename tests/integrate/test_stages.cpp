// The stages of a surface's picture, called one by one.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "src/integrate/fill_channels.h"
#include "src/integrate/light.h"
#include "src/integrate/medium.h"
#include "src/integrate/place.h"
#include "src/integrate/resolve.h"
#include "src/integrate/surface_image.h"
#include "src/integrate/surface_integrator.h"
#include "src/integrate/trace_rays.h"

using namespace strata;
using namespace strata::integrate;

namespace {

using Random = std::mt19937_64;

scene::Scene small_scene(bool has_shadows, double haze_distance) {
    scene::Scene scene;
    scene.film = {.width = 48, .height = 27};
    scene.sampling.N = 2;
    scene.surface.octaves = 5;
    scene.camera.far = 60.0;
    scene.camera.look_at = {0.3, 0.8, 1.0};
    scene.sun.shadows = has_shadows;
    scene.sky.haze_distance = haze_distance;
    return scene;
}

struct Samples {
    std::vector<double> u, v, t;

    SampleBatch batch() const { return {u, v, t}; }
};

// side: of the square that they lie in, px.
Samples random_samples(Random& random, std::size_t count, double side) {
    std::uniform_real_distribution<double> place(0.0, side);
    Samples samples;
    for (std::size_t i = 0; i < count; ++i) {
        samples.u.push_back(place(random));
        samples.v.push_back(place(random));
        samples.t.push_back(0.0);
    }
    return samples;
}

}  // namespace

TEST_CASE("every sample of a batch is in one chunk, none of which is larger than kChunk, however many share a cell") {
    Random random(41);
    const SurfaceSetup fast(small_scene(false, 0.0), Tracer::fast, trace::kStepLimit);
    const SurfaceSetup reference(small_scene(false, 0.0), Tracer::reference, trace::kStepLimit);
    CulledBatch batch;  // its memory is used again
    for (const SurfaceSetup* setup : {&fast, &reference}) {
        for (const double side : {1e-3, 27.0}) {
            for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kChunk, kChunk + 1, 3 * kChunk + 7}) {
                CAPTURE(side);
                CAPTURE(count);
                const Samples samples = random_samples(random, count, side);
                SurfaceChunk chunk;
                Counters counters;
                follow_beams(*setup, samples.batch(), batch, counters);
                std::vector<std::uint32_t> seen;
                while (next_chunk(batch, chunk)) {
                    REQUIRE(!chunk.order.empty());
                    REQUIRE(chunk.order.size() <= kChunk);
                    seen.insert(seen.end(), chunk.order.begin(), chunk.order.end());
                }
                std::ranges::sort(seen);
                std::vector<std::uint32_t> all(count);
                std::iota(all.begin(), all.end(), 0u);
                CHECK(seen == all);
            }
        }
    }
}

// By the reference tracer, which has no beams: nothing need be culled.
TEST_CASE("stages called one by one, on samples in any order, give the picture's bits, counts and costs") {
    constexpr std::size_t kCount = 700;
    Random random(42);
    for (const bool has_shadows : {false, true}) {
        for (const double haze_distance : {0.0, 20.0}) {
            CAPTURE(has_shadows);
            CAPTURE(haze_distance);
            const scene::Scene scene = small_scene(has_shadows, haze_distance);
            const Samples samples = random_samples(random, kCount, 27.0);
            std::vector<glm::vec3> expected(kCount), found(kCount);
            const std::array asked{find_channel("steps"), find_channel("evals")};
            const ChannelSet channels(asked);
            std::vector<float> expected_costs(2 * kCount), costs(2 * kCount);
            Counters of_picture, of_stages;
            SurfaceImage(scene, Tracer::reference)
                .evaluate(samples.batch(), {expected, channels, expected_costs}, of_picture);

            const SurfaceSetup setup(scene, Tracer::reference, trace::kStepLimit);
            std::vector<std::uint32_t> order(kCount);
            std::iota(order.begin(), order.end(), 0u);
            std::ranges::shuffle(order, random);
            SurfaceChunk chunk;
            chunk.order = order;
            place_rays(setup, samples.batch(), chunk, of_stages);
            trace_rays(setup, chunk, of_stages);
            resolve_hits(setup, chunk, of_stages);
            light_hits(setup, chunk, of_stages);
            apply_medium(setup, chunk, of_stages);
            fill_channels(setup, samples.batch(), chunk, {found, channels, costs});
            put_back(chunk, found, of_stages);

            CHECK(of_stages.hits > kCount / 10);
            CHECK(of_stages.hits < kCount);
            CHECK((of_stages.shadow_rays > 0) == has_shadows);
            CHECK(of_stages.hits == of_picture.hits);
            CHECK(of_stages.shadow_rays == of_picture.shadow_rays);
            CHECK(of_stages.noise_evaluations == of_picture.noise_evaluations);
            CHECK(std::memcmp(found.data(), expected.data(), kCount * sizeof(glm::vec3)) == 0);
            std::uint64_t steps = 0, noise_evaluations = 0;
            for (std::size_t i = 0; i < kCount; ++i) {
                steps += static_cast<std::uint64_t>(costs[2 * i]);
                noise_evaluations += static_cast<std::uint64_t>(costs[2 * i + 1]);
            }
            CHECK(costs == expected_costs);
            CHECK(steps == of_stages.steps);
            CHECK(noise_evaluations == of_stages.noise_evaluations);
        }
    }
}
