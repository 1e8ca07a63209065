// Lakes for tests of water in pictures, and what is asked of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "src/integrate/make_image.h"
#include "src/integrate/sample_view.h"
#include "src/scene/toml_reader.h"
#include "tests/integrate/light_samples.h"

namespace strata::water_scenes {

using namespace light_samples;

// A level bed 0.5 under the water.
inline scene::Scene basin(double wind) {
    scene::Scene scene = scene_from_above(0.0);
    scene.water = {.present = true, .level_m = 0.5, .wind_m_s = wind, .waves_m = 0.7};
    scene.water.absorption = scene.water.deep = glm::dvec3(0.0);
    return scene;
}

// A lake 3 deep, a mountain behind it and its foot in the water.
inline scene::Scene lake() {
    return scene::read_scene(R"(

image = "surface"
film = {width = 64, height = 48}
sampling = {N = 2, tolerance = 0.01}
camera = {position = [0.0, 1.0, 0.0], look_at = [0.0, 0.55, 3.0], fov_deg = 50.0, far = 100.0}
surface = {kind = "terrain", origin = [0.0, -3.0, 0.0]}
sun = {direction = [-0.6, 0.5, -0.3]}
water = {present = true, level_m = 3.0, wind_m_s = 0.0, absorption = [1e3, 1e3, 1e3], deep = [0.0, 0.0, 0.0]}
[[relief]]
name = "mountain"
type = "envelope"
z = 13.0
lift = 9.0
[[relief]]
name = "rough"
type = "fbm"
amplitude = 0.4
frequency = 1.0
octaves = 4
[[relief]]
name = "ground"
type = "sum"
of = ["mountain", "rough"]
)",
                             "lake");
}

struct Channels {
    ChannelSet set;
    std::vector<float> values;
    std::vector<glm::vec3> radiance;

    glm::vec3 at(std::size_t sample, const char* name) const {
        glm::vec3 value(0.0f);
        for (const ChannelSet::Entry& entry : set.entries()) {
            if (entry.channel->name != name) continue;
            for (std::size_t c = 0; c < entry.count; ++c)
                value[static_cast<glm::length_t>(c)] = values[sample * set.values() + entry.first + c];
        }
        return value;
    }
};

inline Channels evaluate_all(const scene::Scene& scene, const SampleBatch& batch, Counters* counters = nullptr) {
    std::vector<const Channel*> all;
    for (const Channel& channel : all_channels()) all.push_back(&channel);
    Channels result{ChannelSet(all), {}, std::vector<glm::vec3>(batch.u.size())};
    result.values.resize(batch.u.size() * result.set.values());
    Counters counted;
    make_image(scene)->evaluate(batch, {result.radiance, result.set, result.values},
                                counters != nullptr ? *counters : counted);
    return result;
}

struct Places {
    std::vector<double> u, v, t;

    explicit Places(const scene::Scene& scene, int count = 3000) {
        std::mt19937_64 random(9);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (int i = 0; i < count; ++i) {
            u.push_back(unit(random) * scene.film.width);
            v.push_back(unit(random) * scene.film.height);
            t.push_back(0.0);
        }
    }
    SampleBatch batch() const { return {u, v, t}; }
};

// Where the ground of lake() comes up to the level between the eye and the mountain, by halving.
inline double shore_of(const scene::Scene& scene, double x) {
    const trace::Field field(scene.surface);
    double water = 2.0, ground = 13.0;
    while (ground - water > 1e-9) {
        const double z = 0.5 * (water + ground);
        (field.value({x, 3.0, z}) > 0.0 ? water : ground) = z;
    }
    return water;
}

// The water of lake() is at y = 0 in the world.
inline bool is_water(const Channels& seen, std::size_t sample) {
    return seen.at(sample, "depth").x < 1e9f && std::abs(seen.at(sample, "P").y) < 1e-6f;
}

}  // namespace strata::water_scenes
