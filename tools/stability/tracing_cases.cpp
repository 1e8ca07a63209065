// Rays that are hard on a tracer, each judged by an oracle: grazing, along ridges, from on or in the surface, at Earth's
// size, over cliffs, and at the ends of what keys allow.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "noise/simd_target.h"
#include "tools/stability/case.h"
#include "tools/stability/ray_jury.h"

namespace strata::tools::stability {

namespace {

double uniform(Random& random, double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); }

glm::dvec3 unit_vector(Random& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

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

// A segment's ends, outside and inside, halved until they are neighbours.
glm::dvec3 surface_point(const trace::Field& field, glm::dvec3 outside, glm::dvec3 inside) {
    for (int i = 0; i < 110; ++i) {
        const glm::dvec3 middle = 0.5 * (outside + inside);
        (field.value(middle) > 0.0 ? outside : inside) = middle;
    }
    return outside;
}

// A random point of the surface, the last double outside it along a line; nothing if the line misses it.
std::optional<glm::dvec3> random_surface_point(const trace::Field& field, Random& random) {
    const scene::Surface& s = field.surface();
    const double height = 1.01 * field.amplitude() + 1e-9 * s.radius;
    glm::dvec3 outside, inside;
    if (s.kind == scene::SurfaceKind::planet) {
        const glm::dvec3 up = unit_vector(random);
        outside = (s.radius + height) * up;
        inside = (s.radius - height) * up;
    } else if (s.kind == scene::SurfaceKind::isosurface) {
        outside = uniform(random, 0.0, 0.6) * s.bound_size.x * unit_vector(random);
        inside = uniform(random, 0.0, 0.6) * s.bound_size.x * unit_vector(random);
    } else {
        outside = {uniform(random, -40.0, 40.0), height, uniform(random, -40.0, 40.0)};
        inside = outside * glm::dvec3(1.0, -1.0, 1.0);
    }
    if (field.value(outside) <= 0.0 || field.value(inside) > 0.0) return std::nullopt;
    return surface_point(field, outside, inside);
}

// Tangents lifted or sunk by 1e-12 to 1e-3 of a lattice cell, most by no more than 1e-6.
std::vector<WorldRay> grazing_rays(const RayJury& jury, Random& random, int count) {
    const double cell = 1.0 / jury.scene().surface.frequency;
    std::vector<WorldRay> rays;
    for (int tries = 0; static_cast<int>(rays.size()) < count && tries < 40 * count; ++tries) {
        const auto x = random_surface_point(jury.field(), random);
        if (!x) continue;
        const glm::dvec3 normal = glm::normalize(jury.field().gradient(*x));
        const glm::dvec3 tangent = glm::normalize(glm::cross(normal, unit_vector(random)));
        const double lift = cell * std::pow(10.0, uniform(random, -12.0, tries % 4 == 0 ? -3.0 : -6.0));
        const glm::dvec3 from = *x + (tries % 2 ? lift : -lift) * normal - uniform(random, 0.0, 0.4) * cell * tangent;
        rays.push_back({.origin = from, .direction = tangent, .pixel = {}});
    }
    return rays;
}

// Level along crests: from a point of greatest height across, found by ascent, in both directions of least curvature,
// lifted or sunk by up to 1e-6 of a cell.
std::vector<WorldRay> ridge_rays(const RayJury& jury, Random& random, int count) {
    const trace::Field& field = jury.field();
    const double cell = 1.0 / jury.scene().surface.frequency;
    std::vector<WorldRay> rays;
    while (static_cast<int>(rays.size()) < count) {
        glm::dvec3 x{uniform(random, -40.0, 40.0), 0.0, uniform(random, -40.0, 40.0)};
        // The gradient of y - h is (-h_x, 1, -h_z): walk against it, by ever shorter steps.
        for (double step = 0.1 * cell; step > 1e-7 * cell; step *= 0.97) {
            const glm::dvec3 g = field.gradient(x);
            const glm::dvec3 up = glm::dvec3(-g.x, 0.0, -g.z);
            if (glm::length(up) == 0.0) break;
            x += step * glm::normalize(up);
        }
        x.y = 0.0;
        const double height = -field.value(x);
        glm::dvec3 along{1.0, 0.0, 0.0};
        double flattest = 1e300;
        for (int k = 0; k < 32; ++k) {
            const double angle = 0.0981747704246810387 * k, reach = 0.05 * cell;
            const glm::dvec3 d{std::cos(angle), 0.0, std::sin(angle)};
            const double drop = std::abs(2.0 * height + field.value(x + reach * d) + field.value(x - reach * d));
            if (drop < flattest) flattest = drop, along = d;
        }
        const double lift = cell * std::pow(10.0, uniform(random, -13.0, -6.0)) * (random() % 2 ? 1.0 : -1.0);
        rays.push_back({.origin = glm::dvec3(x.x, height + lift, x.z) - 0.3 * cell * along, .direction = along, .pixel = {}});
    }
    return rays;
}

// From the last double outside, the first inside and deep inside, along the normal, against it, across it and anywhere.
std::vector<WorldRay> starting_rays(const RayJury& jury, Random& random, int count) {
    std::vector<WorldRay> rays;
    for (int tries = 0; static_cast<int>(rays.size()) < count && tries < 40 * count; ++tries) {
        const auto x = random_surface_point(jury.field(), random);
        if (!x) continue;
        const glm::dvec3 normal = glm::normalize(jury.field().gradient(*x));
        const glm::dvec3 tangent = glm::normalize(glm::cross(normal, unit_vector(random)));
        const double size = std::max(1.0, glm::length(*x));
        const glm::dvec3 from = *x - (tries % 3 == 0 ? 0.0 : tries % 3 == 1 ? 4e-16 * size : 0.1) * normal;
        for (const glm::dvec3& direction : {normal, -normal, tangent, unit_vector(random)}) {
            rays.push_back({.origin = from, .direction = direction, .pixel = {}});
        }
    }
    return rays;
}

// Pixels anywhere, and pairs of neighbours about the silhouettes of columns: between a hit and a miss above it.
std::vector<WorldRay> pixel_rays(const RayJury& jury, Random& random, int count) {
    const scene::Film& film = jury.scene().film;
    const auto at = [](int x, int y) { return WorldRay{.pixel = glm::ivec2(x, y)}; };
    const auto hits = [&](const WorldRay& ray) {
        const trace::Ray local = jury.local(ray);
        return jury.trace({&local, 1}).front().state == trace::HitState::hit;
    };
    std::vector<WorldRay> rays;
    for (int i = 0; i < count; ++i) {
        const int x = static_cast<int>(random() % static_cast<unsigned>(film.width));
        if (i % 3 != 0) {
            rays.push_back(at(x, static_cast<int>(random() % static_cast<unsigned>(film.height))));
            continue;
        }
        int miss = 0, hit = film.height - 1;
        if (!hits(at(x, hit)) || hits(at(x, miss))) continue;
        while (hit - miss > 1) (hits(at(x, (hit + miss) / 2)) ? hit : miss) = (hit + miss) / 2;
        rays.push_back(at(x, miss));
        rays.push_back(at(x, hit));
    }
    return rays;
}

using MakeRays = std::vector<WorldRay> (*)(const RayJury&, Random&, int);

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
    const std::string statistics = fmt::format("mean {:.1f}, median {}, 99.9 % {} of {} pixels; ", sum / n,
                                               steps[steps.size() / 2].first, steps[steps.size() * 999 / 1000].first, n);
    const std::string worst = jury.replay(pixels[steps.back().second]);
    return {{scene_name + " 1920x1080: most steps of a pixel", Kind::information, static_cast<double>(steps.back().first),
             0.0, "steps", statistics + worst, {}},
            {scene_name + " 1920x1080: unresolved pixels", Kind::check, unresolved, 0.0, "pixels", worst, {}}};
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
        {"amplitude 0, Earth, grazing, tolerance 1e-12", with(earth_spec(), {"surface.amplitude=0", "sampling.tolerance=1e-12"}), grazing_rays},
        {"cliffs of slope 1e3, terrain", with(terrain, {"surface.amplitude=150", "surface.frequency=3.3", "surface.octaves=4"}), pixel_rays},
        {"cliffs of slope 1e3, terrain, grazing", with(terrain, {"surface.amplitude=150", "surface.frequency=3.3", "surface.octaves=4"}), grazing_rays},
        {"cliffs of slope 1e3, hyperterrain", with(hyper, {"surface.amplitude=80", "surface.frequency=3.3", "surface.octaves=3"}), starting_rays},
        {"far 1e12, terrain", with(terrain, {"camera.far=1e12", "surface.frequency=0.05", "surface.octaves=8"}), pixel_rays},
        {"far 1e12, fov 0.01, level", with(terrain, {"camera.far=1e12", "surface.frequency=0.05", "surface.octaves=8", "camera.fov_deg=0.01", "camera.position=[0,2,0]", "camera.look_at=[0,1.9999,1]"}), pixel_rays},
        {"tolerance 1e-12, terrain", with(terrain, {"sampling.tolerance=1e-12", "camera.far=40"}), pixel_rays},
        {"tolerance 1e-12, fov 0.01, hyperterrain", with(hyper, {"sampling.tolerance=1e-12", "camera.fov_deg=0.01"}), pixel_rays},
        {"tolerance 1e-12, isosurface, grazing", with(iso, {"sampling.tolerance=1e-12"}), grazing_rays},
        {"fov 179, isosurface next to the eye", with(iso, {"sampling.tolerance=0.01", "camera.fov_deg=179", "camera.position=[0,0,-1.6001]", "film.width=64", "film.height=64"}), pixel_rays},
        {"frequency 1e-9, amplitude 1e6, terrain", with(terrain, {"surface.frequency=1e-9", "surface.amplitude=1e6", "surface.octaves=6", "camera.far=1e9", "camera.position=[0,9e5,0]", "camera.look_at=[0,0,1e7]"}), pixel_rays},
        {"frequency 1e9, amplitude 1e-9, hyperterrain", with(hyper, {"surface.frequency=1e9", "surface.amplitude=1e-9", "surface.octaves=3", "camera.far=2e-7", "camera.position=[0,1.3e-8,0]", "camera.look_at=[0,0,1e-7]"}), pixel_rays},
        {"32 octaves, lacunarity 1.0001, gain 1, hyperterrain", with(hyper, {"surface.octaves=32", "surface.lacunarity=1.0001", "surface.gain=1", "surface.amplitude=0.05"}), pixel_rays},
        {"32 octaves, lacunarity 1, gain 1, isosurface", with(iso, {"surface.octaves=32", "surface.lacunarity=1", "surface.gain=1", "surface.amplitude=0.1"}), pixel_rays},
        {"lacunarity 10, gain 0.1, terrain", with(terrain, {"surface.lacunarity=10", "surface.gain=0.1", "surface.octaves=10", "camera.far=40"}), pixel_rays},
        {"gain 1, lacunarity 2, 6 octaves, hyperterrain", with(hyper, {"surface.gain=1", "surface.octaves=6", "surface.amplitude=0.1"}), pixel_rays},
        {"1 octave 2^40 cells from the origin, hyperterrain", with(hyper, {"surface.octaves=1", "surface.frequency=2", "camera.position=[549755813888,1.5,-549755813888]", "camera.look_at=[549755813888,1,-549755813882]", "camera.far=1000"}), pixel_rays},
        {"bound touched from inside, isosurface all solid", with(iso, {"surface.threshold=-5"}), pixel_rays},
        {"scale 1e-6, turned, far from the world's origin", with(iso, {"surface.scale=1e-6", "surface.origin=[1e3,-2e3,3e3]", "surface.rotation_deg=[10,20,30]", "camera.position=[1e3,-2e3,2999.999993]", "camera.look_at=[1e3,-2e3,3e3]"}), pixel_rays},
    };
}

}  // namespace

void add_tracing_cases(std::vector<Case>& cases) {
    const auto add = [&](const std::string& name, const std::string& target, const SceneSpec& spec, MakeRays make, int full,
                         int subset) {
        cases.push_back({"tracing", name,
                         [=](const Settings& s, Random& r) { return judged(spec, name, make, full, subset, s, r); }, target});
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
        cases.push_back({"tracing", "Earth from " + place.name,
                         [=](const Settings& s, Random& r) { return earth(place, s, r); }, {}});
    }
    add("Earth in metres, grazing to 1e-6", {}, earth_spec(), grazing_rays, 1000, 20);
    add("Earth in metres, from on and in the surface", {}, earth_spec(), starting_rays, 1000, 20);
    for (const Extreme& extreme : extremes()) add(extreme.name, {}, extreme.spec, extreme.make, 800, 25);
    add_families("", {}, 4000, 60);
    for (const char* name : {"terrain"}) add(std::string(name) + ", along ridges", {}, surface_spec(name), ridge_rays, 800, 20);
    for (const char* name : {"terrain", "hyperterrain", "planet", "isosurface"}) {
        cases.push_back({"tracing", std::string("steps, ") + name,
                         [=](const Settings& s, Random& r) { return step_statistics(name, s, r); }, {}});
    }
    const std::vector<std::string> targets = noise::simd_targets();
    for (std::size_t i = 1; i < targets.size(); ++i) add_families(targets[i] + ": ", targets[i], 800, 20);
}

}  // namespace strata::tools::stability
