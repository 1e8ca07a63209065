// Scenes whose keys lie anywhere in their ranges, most near an end: whatever is not refused must keep the promises.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "src/scene/scene_error.h"
#include "tools/stability/case.h"
#include "tools/stability/hard_rays.h"
#include "tools/stability/ray_jury.h"

namespace strata::tools::stability {

namespace {

// One end or the other of a range, or anywhere between by its logarithm.
double extreme(Random& random, double low, double high) {
    switch (random() % 4) {
        case 0:
            return low;
        case 1:
            return high;
        default:
            return log_uniform(random, low, high);
    }
}

SceneSpec random_spec(Random& random) {
    constexpr std::array<const char*, 4> kNames = {"terrain", "hyperterrain", "planet", "isosurface"};
    SceneSpec spec{kNames[random() % kNames.size()], {"surface.spin_deg_per_s=0", "film.width=640", "film.height=480"}};
    const auto set = [&](const char* key, double value) { spec.sets.push_back(set_number(key, value)); };
    const double frequency = extreme(random, 1e-9, 1e9), scale = extreme(random, 1e-9, 1e9);
    // Amplitudes from a flat to a steep surface, or anything.
    const double amplitude =
        random() % 4 ? std::min(1e6, log_uniform(random, 1e-4, 1e3) / frequency) : extreme(random, 1e-12, 1e6);
    set("surface.octaves", static_cast<double>(1 + random() % (random() % 4 ? 8 : 32)));
    set("surface.lacunarity", random() % 3 ? uniform(random, 1.5, 3.0) : extreme(random, 1.0, 10.0));
    set("surface.gain", random() % 3 ? uniform(random, 0.3, 0.7) : extreme(random, 1e-3, 1.0));
    set("surface.frequency", frequency);
    set("surface.amplitude", random() % 20 ? amplitude : 0.0);
    set("surface.scale", scale);
    set("surface.seed", static_cast<double>(random() % 1000));
    set("sampling.tolerance", extreme(random, 1e-12, 1.0));
    set("camera.fov_deg", extreme(random, 0.01, 179.0));
    double size = std::max(amplitude, 1.0 / frequency);
    if (spec.name == "planet") {
        const double radius = std::clamp(size * log_uniform(random, 1.0, 1e9), 1e-9, 1e9);
        set("surface.radius", radius);
        size = radius;
    } else if (spec.name == "isosurface") {
        const double bound = std::clamp(size * log_uniform(random, 0.5, 20.0), 1e-9, 1e9);
        set("surface.threshold", 0.2 * amplitude * uniform(random, -1.0, 1.0));
        spec.sets.push_back(random() % 2 ? "surface.bound=ball" : "surface.bound=box");
        spec.sets.push_back(set_vector("surface.bound_size", glm::dvec3(bound)));
        size = bound;
    }
    const glm::dvec3 origin =
        random() % 2 ? glm::dvec3(0.0) : scale * size * extreme(random, 1e-3, 1e6) * unit_vector(random);
    glm::dvec3 eye = size * uniform(random, 0.9, 3.0) * unit_vector(random);
    if (spec.name == "terrain" || spec.name == "hyperterrain") eye.y = amplitude * log_uniform(random, 1e-3, 10.0);
    const glm::dvec3 target = random() % 2 ? glm::dvec3(0.0) : eye + size * unit_vector(random);
    spec.sets.push_back(set_vector("surface.origin", origin));
    spec.sets.push_back(set_vector("camera.position", origin + scale * eye));
    spec.sets.push_back(set_vector("camera.look_at", origin + scale * target));
    set("camera.far", scale * size * log_uniform(random, 1.0, 1e4));
    return spec;
}

// Slopes of 10^12 and tolerances of 10^-12 pixels can ask for more steps than any limit; they are counted.
constexpr std::uint32_t kFewSteps = 1u << 15;

// Each scene by a few of its pixels.
std::vector<Row> random_scenes(const std::string& name, const Settings& settings, Random& random) {
    int rendered = 0, refused = 0;
    long rays = 0, hits = 0, in_part = 0;
    double broken = 0.0, unresolved = 0.0, not_finite = 0.0;
    std::string where;
    while (rendered < settings.trials(800, 12) && !settings.cancelled()) {
        const SceneSpec spec = random_spec(random);
        std::optional<RayJury> jury;
        try {
            jury.emplace(spec, settings, kFewSteps);
        } catch (const scene::SceneError&) {
            ++refused;
            continue;
        }
        ++rendered;
        std::vector<WorldRay> pixels(16);
        for (WorldRay& ray : pixels) {
            const auto x = static_cast<int>(random() % 640), y = static_cast<int>(random() % 480);
            ray.pixel = glm::ivec2(x, y);
        }
        jury->judge(pixels);
        std::vector<double> u, v;
        for (const WorldRay& pixel : pixels) {
            u.push_back(pixel.pixel->x + 0.5);
            v.push_back(pixel.pixel->y + 0.5);
        }
        const std::vector<double> t(u.size(), 0.0);
        std::vector<glm::vec3> radiance(u.size());
        integrate::Counters counters;
        jury->image().evaluate({u, v, t}, radiance, counters);
        for (std::size_t i = 0; i < radiance.size(); ++i) {
            if (std::isfinite(radiance[i].r + radiance[i].g + radiance[i].b)) continue;
            ++not_finite;
            where = jury->replay(pixels[i]);
        }
        rays += jury->judged();
        hits += jury->hits();
        in_part += jury->judged_in_part();
        broken += static_cast<double>(jury->violations());
        unresolved += static_cast<double>(jury->unresolved());
        if (jury->violations() > 0) where = jury->violation();
    }
    const std::string counts = fmt::format("{} scenes, {} more refused; {} rays, {} hits, {} judged in part; {}",
                                           rendered, refused, rays, hits, in_part, where);
    return {check(name + ": broken promises", broken, 0.0, "rays", counts),
            information(name + ": not settled in 2^15 steps",
                        100.0 * unresolved / std::max(1.0, static_cast<double>(rays)), "% of rays", counts),
            check(name + ": radiance that is not finite", not_finite, 0.0, "rays", counts)};
}

}  // namespace

void add_random_scene_cases(std::vector<Case>& cases) {
    for (int part = 1; part <= 4; ++part) {
        const std::string name = fmt::format("keys anywhere in their ranges, part {}", part);
        cases.push_back({"tracing", name, [=](const Settings& s, Random& r) { return random_scenes(name, s, r); }});
    }
}

}  // namespace strata::tools::stability
