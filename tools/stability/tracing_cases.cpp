// Rays that are hard on a tracer, each judged by an oracle: grazing, along ridges, from on or in the surface, at
// Earth's size, over cliffs, and at the ends of what keys allow.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "noise/simd_target.h"
#include "tools/stability/case.h"
#include "tools/stability/hard_rays.h"
#include "tools/stability/ray_jury.h"

namespace strata::tools::stability {

namespace {

constexpr double kEarth = 6.371e6;  // m

// Surfaces of every kind, at rest and where the world's axes are their own.
SceneSpec surface_spec(const std::string& name) {
    return {name, {"surface.spin_deg_per_s=0", "sampling.tolerance=0.1", "film.width=1920", "film.height=1080"}};
}

// A planet of Earth's radius in metres: mountains of 100 km down to cells of 0.8 m.
SceneSpec earth_spec() {
    SceneSpec spec = surface_spec("planet");
    for (const char* set : {"surface.radius=6.371e6", "surface.frequency=1e-5", "surface.octaves=18",
                            "surface.amplitude=3000", "surface.gain=0.5", "camera.far=1e8"}) {
        spec.sets.emplace_back(set);
    }
    return spec;
}

std::vector<Row> judged(const SceneSpec& spec, const std::string& name, MakeRays make, int full, int subset,
                        const Settings& settings, Random& random) {
    RayJury jury(spec, settings);
    jury.judge(make(jury, random, settings.trials(full, subset)));
    return jury.rows(name);
}

SceneSpec with(SceneSpec spec, const std::vector<std::string>& sets) {
    spec.sets.insert(spec.sets.end(), sets.begin(), sets.end());
    return spec;
}

struct Place {
    std::string name;
    double height;      // over the ground below, m
    glm::dvec3 target;  // from there, in units of the height at least 1 m; y up
    double fov_deg;
};

// The eye over the north pole, looking at the horizon.
std::vector<Row> earth(const Place& place, const Settings& settings, Random& random) {
    SceneSpec spec = earth_spec();
    const trace::Field field(spec.scene().surface);
    const double ground = surface_point(field, {0.0, kEarth + 9000.0, 0.0}, {0.0, kEarth - 9000.0, 0.0}).y;
    const glm::dvec3 eye{0.0, ground + place.height, 0.0};
    spec = with(spec, {set_vector("camera.position", eye), set_vector("camera.look_at", eye + place.target),
                       set_number("camera.fov_deg", place.fov_deg)});
    return judged(spec, "Earth in metres, from " + place.name, pixel_rays, 1500, 40, settings, random);
}

// The numbers of steps over a coarse grid of a scene's pixels; the worst is named as a command.
std::vector<Row> step_statistics(const std::string& scene_name, const Settings& settings, Random&) {
    const SceneSpec spec = surface_spec(scene_name);
    const RayJury jury(spec, settings);
    std::vector<WorldRay> pixels;
    const int stride = settings.trials(6, 24);
    for (int y = 0; y < jury.scene().film.height; y += stride) {
        for (int x = 0; x < jury.scene().film.width; x += stride) pixels.push_back({.pixel = glm::ivec2(x, y)});
    }
    std::vector<trace::Ray> rays;
    rays.reserve(pixels.size());
    for (const WorldRay& pixel : pixels) rays.push_back(jury.local(pixel));
    std::vector<std::pair<std::uint32_t, std::size_t>> steps;
    double sum = 0.0, unresolved = 0.0;
    const std::vector<trace::Hit> hits = jury.trace(rays);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        steps.emplace_back(hits[i].steps, i);
        sum += hits[i].steps;
        unresolved += hits[i].state == trace::HitState::unresolved;
    }
    std::sort(steps.begin(), steps.end());
    const double n = static_cast<double>(steps.size());
    const std::string statistics =
        fmt::format("mean {:.1f}, median {}, 99.9 % {} of {} pixels; ", sum / n, steps[steps.size() / 2].first,
                    steps[steps.size() * 999 / 1000].first, n);
    const std::string worst = jury.replay(pixels[steps.back().second]);
    return {information(scene_name + " 1920x1080: most steps of a pixel", static_cast<double>(steps.back().first),
                        "steps", statistics + worst),
            check(scene_name + " 1920x1080: unresolved pixels", unresolved, 0.0, "pixels", worst)};
}

// Tangents of a smooth ball of Earth's radius, lifted or sunk by 1e-12 to 1e-5 m, at the finest tolerance: how deep a
// chord is passed over, and how high over the ball a hit is reported. Against the closed form, in long double: the
// distance from the centre to the line. A chord shorter than delta is allowed, and adds delta^2 / 8 R, below 1e-23 m.
std::vector<Row> tangents(const Settings& settings, Random& random) {
    const SceneSpec spec =
        with(earth_spec(), {"surface.amplitude=0", "sampling.tolerance=1e-12", "camera.fov_deg=0.01"});
    const RayJury jury(spec, settings);
    Worst passed, imagined;
    for (int i = 0; i < settings.trials(20000, 1000); ++i) {
        const glm::dvec3 up = unit_vector(random), along = glm::normalize(glm::cross(up, unit_vector(random)));
        const double lift = std::pow(10.0, uniform(random, -12.0, -5.0)) * (i % 2 ? 1.0 : -1.0);
        const WorldRay world{.origin = (kEarth + lift) * up - std::pow(10.0, uniform(random, 1.0, 6.0)) * along,
                             .direction = along,
                             .pixel = {}};
        const trace::Ray ray = jury.local(world);
        const trace::Hit hit = jury.trace({&ray, 1}).front();
        long double across = 0.0L, length2 = 0.0L;
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            const long double product =
                static_cast<long double>(ray.origin[b]) * static_cast<long double>(ray.direction[c]) -
                static_cast<long double>(ray.origin[c]) * static_cast<long double>(ray.direction[b]);
            across += product * product;
            length2 += static_cast<long double>(ray.direction[a]) * static_cast<long double>(ray.direction[a]);
        }
        const double over = static_cast<double>(std::sqrt(across / length2) - static_cast<long double>(kEarth));
        const bool is_hit = hit.state == trace::HitState::hit;
        const auto where = [&] { return jury.replay(world); };
        if (!is_hit && over < 0.0) passed.see(-over, where);
        if (is_hit && hit.s > 0.0 && over > 0.0) imagined.see(over, where);
    }
    // The rounding of f, and that of the ray's unit direction, 2^-53 an axis over up to 1e6 m.
    const double bound = jury.rounding(2.0 * kEarth) + 2.0 * 0x1p-53 * 1e6;
    return {check("Earth without relief, tolerance 1e-12: deepest chord passed over", std::max(0.0, passed.value()),
                  bound, "m", passed.where()),
            check("Earth without relief, tolerance 1e-12: highest hit beside it", std::max(0.0, imagined.value()),
                  bound, "m", imagined.where())};
}

struct Extreme {
    std::string name;
    SceneSpec spec;
    MakeRays make;
};

std::vector<Extreme> extremes() {
    const SceneSpec terrain = surface_spec("terrain"), hyper = surface_spec("hyperterrain"),
                    iso = surface_spec("isosurface");
    return {
        {"amplitude 0, terrain", with(terrain, {"surface.amplitude=0"}), pixel_rays},
        {"amplitude 0, terrain, grazing", with(terrain, {"surface.amplitude=0"}), grazing_rays},
        {"amplitude 0, Earth, grazing, tolerance 1e-12",
         with(earth_spec(), {"surface.amplitude=0", "sampling.tolerance=1e-12"}), grazing_rays},
        {"cliffs of slope 1e3, terrain",
         with(terrain, {"surface.amplitude=150", "surface.frequency=3.3", "surface.octaves=4"}), pixel_rays},
        {"cliffs of slope 1e3, terrain, grazing",
         with(terrain, {"surface.amplitude=150", "surface.frequency=3.3", "surface.octaves=4"}), grazing_rays},
        {"cliffs of slope 1e3, hyperterrain",
         with(hyper, {"surface.amplitude=80", "surface.frequency=3.3", "surface.octaves=3"}), starting_rays},
        {"far 1e12, terrain", with(terrain, {"camera.far=1e12", "surface.frequency=0.05", "surface.octaves=8"}),
         pixel_rays},
        {"far 1e12, fov 0.01, level",
         with(terrain, {"camera.far=1e12", "surface.frequency=0.05", "surface.octaves=8", "camera.fov_deg=0.01",
                        "camera.position=[0,2,0]", "camera.look_at=[0,1.9999,1]"}),
         pixel_rays},
        {"tolerance 1e-12, terrain", with(terrain, {"sampling.tolerance=1e-12", "camera.far=40"}), pixel_rays},
        {"tolerance 1e-12, fov 0.01, hyperterrain", with(hyper, {"sampling.tolerance=1e-12", "camera.fov_deg=0.01"}),
         pixel_rays},
        {"tolerance 1e-12, isosurface, grazing", with(iso, {"sampling.tolerance=1e-12"}), grazing_rays},
        {"fov 179, isosurface next to the eye",
         with(iso, {"sampling.tolerance=0.01", "camera.fov_deg=179", "camera.position=[0,0,-1.6001]", "film.width=64",
                    "film.height=64"}),
         pixel_rays},
        {"frequency 1e-9, amplitude 1e6, terrain",
         with(terrain, {"surface.frequency=1e-9", "surface.amplitude=1e6", "surface.octaves=6", "camera.far=1e9",
                        "camera.position=[0,9e5,0]", "camera.look_at=[0,0,1e7]"}),
         pixel_rays},
        {"frequency 1e9, amplitude 1e-9, hyperterrain",
         with(hyper, {"surface.frequency=1e9", "surface.amplitude=1e-9", "surface.octaves=3", "camera.far=2e-7",
                      "camera.position=[0,1.3e-8,0]", "camera.look_at=[0,0,1e-7]"}),
         pixel_rays},
        {"32 octaves, lacunarity 1.0001, gain 1, hyperterrain",
         with(hyper, {"surface.octaves=32", "surface.lacunarity=1.0001", "surface.gain=1", "surface.amplitude=0.05"}),
         pixel_rays},
        {"32 octaves, lacunarity 1, gain 1, isosurface",
         with(iso, {"surface.octaves=32", "surface.lacunarity=1", "surface.gain=1", "surface.amplitude=0.1"}),
         pixel_rays},
        {"lacunarity 10, gain 0.1, terrain",
         with(terrain, {"surface.lacunarity=10", "surface.gain=0.1", "surface.octaves=10", "camera.far=40"}),
         pixel_rays},
        {"gain 1, lacunarity 2, 6 octaves, hyperterrain",
         with(hyper, {"surface.gain=1", "surface.octaves=6", "surface.amplitude=0.1"}), pixel_rays},
        {"1 octave 2^40 cells from the origin, hyperterrain",
         with(hyper, {"surface.octaves=1", "surface.frequency=2", "camera.position=[549755813888,1.5,-549755813888]",
                      "camera.look_at=[549755813888,1,-549755813882]", "camera.far=1000"}),
         pixel_rays},
        {"noise that has drifted 2^30 cells, hyperterrain",
         with(hyper, {"surface.drift=[1000,500,-800]", "shutter.fps=1", "shutter.frame=2000000"}), pixel_rays},
        {"bound touched from inside, isosurface all solid", with(iso, {"surface.threshold=-5"}), pixel_rays},
        {"scale 1e-6, turned, far from the world's origin",
         with(iso, {"surface.scale=1e-6", "surface.origin=[1e3,-2e3,3e3]", "surface.rotation_deg=[10,20,30]",
                    "camera.position=[1e3,-2e3,2999.999993]", "camera.look_at=[1e3,-2e3,3e3]"}),
         pixel_rays},
    };
}

}  // namespace

void add_tracing_cases(std::vector<Case>& cases) {
    const auto add = [&](const std::string& name, const std::string& target, const SceneSpec& spec, MakeRays make,
                         int full, int subset) {
        cases.push_back({"tracing", name,
                         [=](const Settings& s, Random& r) { return judged(spec, name, make, full, subset, s, r); },
                         target});
    };
    const auto add_families = [&](const std::string& prefix, const std::string& target, int full, int subset) {
        for (const char* name : {"terrain", "hyperterrain", "planet", "isosurface"}) {
            const SceneSpec spec = surface_spec(name);
            add(prefix + name + ", grazing to 1e-6", target, spec, grazing_rays, full, subset);
            add(prefix + name + ", from on and in the surface", target, spec, starting_rays, full, subset);
        }
    };
    for (const Place& place : {Place{"orbit, 400 km", 4e5, {0.0, -0.35, 1.0}, 40.0},
                               Place{"orbit, 36,000 km", 3.6e7, {0.0, -1.0, 0.15}, 10.0},
                               Place{"2 m above the ground", 2.0, {0.0, -0.02, 1.0}, 50.0},
                               Place{"2 m through a telescope", 2.0, {0.0, -0.0008, 1.0}, 0.1}}) {
        cases.push_back(
            {"tracing", "Earth from " + place.name, [=](const Settings& s, Random& r) { return earth(place, s, r); }});
    }
    cases.push_back({"tracing", "tangents of Earth", tangents});
    add("Earth in metres, grazing to 1e-6", {}, earth_spec(), grazing_rays, 1000, 20);
    add("Earth in metres, from on and in the surface", {}, earth_spec(), starting_rays, 1000, 20);
    for (const Extreme& extreme : extremes()) add(extreme.name, {}, extreme.spec, extreme.make, 800, 25);
    add_families("", {}, 4000, 60);
    for (const char* name : {"terrain"})
        add(std::string(name) + ", along ridges", {}, surface_spec(name), ridge_rays, 800, 20);
    for (const char* name : {"terrain", "hyperterrain", "planet", "isosurface"}) {
        cases.push_back({"tracing", std::string("steps, ") + name,
                         [=](const Settings& s, Random& r) { return step_statistics(name, s, r); }});
    }
    const std::vector<std::string> targets = noise::simd_targets();
    for (std::size_t i = 1; i < targets.size(); ++i) add_families(targets[i] + ": ", targets[i], 800, 20);
}

}  // namespace strata::tools::stability
