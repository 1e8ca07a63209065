// Surface, camera and sun moved, scaled and turned together: the same picture.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "noise/bounds.h"
#include "noise/float_error.h"
#include "tools/stability/case.h"
#include "tools/stability/ray_jury.h"

namespace strata::tools::stability {

namespace {

// x -> shift + turn (scale x).
struct Motion {
    std::string name;
    double scale = 1.0;
    glm::dvec3 turn_deg{0.0};  // about x, then y, then z
    glm::dvec3 shift{0.0};
    bool exact = false;  // no operation of it rounds
};

// Its own matrices, in long double.
glm::dvec3 turned(const glm::dvec3& degrees, const glm::dvec3& v) {
    std::array<long double, 3> x = {v.x, v.y, v.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const long double angle =
            static_cast<long double>(degrees[static_cast<int>(axis)]) / 180.0L * std::numbers::pi_v<long double>;
        const long double c = std::cos(angle), s = std::sin(angle);
        long double& a = x[(axis + 1) % 3];
        long double& b = x[(axis + 2) % 3];
        const long double rotated = c * a - s * b;
        b = s * a + c * b;
        a = rotated;
    }
    return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

SceneSpec moved(const SceneSpec& base, const Motion& motion) {
    const scene::Scene scene = base.scene();
    const auto point = [&](const glm::dvec3& x) { return motion.shift + turned(motion.turn_deg, motion.scale * x); };
    SceneSpec spec = base;
    for (std::string set : {set_vector("camera.position", point(scene.camera.position)),
                            set_vector("camera.look_at", point(scene.camera.look_at)),
                            set_vector("camera.up", turned(motion.turn_deg, scene.camera.up)),
                            set_number("camera.far", motion.scale * scene.camera.far),
                            set_vector("sun.direction", turned(motion.turn_deg, scene.sun.direction)),
                            set_vector("surface.origin", point(scene.surface.origin)),
                            set_number("surface.scale", motion.scale * scene.surface.scale),
                            set_vector("surface.rotation_deg", motion.turn_deg)}) {
        spec.sets.push_back(std::move(set));
    }
    return spec;
}

// White and lit by the sun alone, so that radiance is intensity / pi times the cosine of its light. Numbers are dyadic
// so that moving them by whole cells is exact.
SceneSpec base_spec(const std::string& name, bool shadows) {
    SceneSpec spec{
        name,
        {"surface.spin_deg_per_s=0", "sampling.tolerance=0.01", "surface.octaves=4", "surface.frequency=0.25",
         "surface.amplitude=1", "sky.zenith=[0,0,0]", "sky.horizon=[0,0,0]", "sky.haze_distance=0",
         "material.low=[1,1,1]", "material.high=[1,1,1]", "material.steep=[1,1,1]", "sun.intensity=3.14159265358979312",
         "sun.colour=[1,1,1]", "sun.direction=[-0.75,0.5,0.25]", shadows ? "sun.shadows=true" : "sun.shadows=false"}};
    const bool ball = name == "planet" || name == "isosurface";
    if (name == "isosurface") spec.sets.insert(spec.sets.end(), {"surface.bound_size=[8,8,8]"});
    spec.sets.insert(spec.sets.end(),
                     {ball ? "camera.position=[1.5,4.25,-22.5]" : "camera.position=[0.5,1.75,0.125]",
                      ball ? "camera.look_at=[0.5,0.25,0.125]" : "camera.look_at=[1.5,1.5,6.25]", "camera.far=128"});
    return spec;
}

struct Picture {
    std::vector<trace::Ray> rays;
    std::vector<trace::Hit> hits;
    std::vector<double> radiance;
};

Picture picture(const RayJury& jury) {
    const scene::Film& film = jury.scene().film;
    Picture result;
    std::vector<double> u, v, t;
    for (int y = 0; y < film.height; ++y) {
        for (int x = 0; x < film.width; ++x) {
            result.rays.push_back(jury.local({.pixel = glm::ivec2(x, y)}));
            u.push_back(x + 0.5);
            v.push_back(y + 0.5);
            t.push_back(0.0);
        }
    }
    result.hits = jury.trace(result.rays);
    std::vector<glm::vec3> radiance(u.size());
    integrate::Counters counters;
    jury.image().evaluate({u, v, t}, radiance, counters);
    for (const glm::vec3& r : radiance) result.radiance.push_back(static_cast<double>(r.g));
    return result;
}

// How far rounding may put a point of the moved ray from the one it should be, in surface units, with u = 2^-53. Each
// coordinate that was moved is rounded three times at most (turn, scale, shift) at the size of the largest, P: the eye
// is off by 6 u P; the view's direction by twice as much over the distance to look_at, and by 24 u of its own
// arithmetic.
struct Displacement {
    double at_eye, an_unit;

    Displacement(const scene::Scene& scene, double scale) {
        const double u = 0x1p-53;
        const double size =
            glm::length(scene.camera.position) + glm::length(scene.surface.origin) + glm::length(scene.camera.look_at);
        at_eye = 6.0 * u * size / scale;
        an_unit = 2.0 * 6.0 * u * size / glm::distance(scene.camera.position, scene.camera.look_at) + 24.0 * u;
    }
    double at(double s) const { return at_eye + s * an_unit; }
};

// On a height field |grad f| >= 1, so that unit normals differ by no more than gradients do: by the largest second
// derivative times the distance d between two hits, and twice the float gradient's error (noise/float_error.h) and a
// few roundings of the normal.
double radiance_bound(const trace::Field& field, double distance) {
    const noise::NoiseBounds& bounds = field.is_planar_noise() ? noise::kBounds2 : noise::kBounds3;
    const noise::FloatErrors& errors = field.is_planar_noise() ? noise::kFloatErrors2 : noise::kFloatErrors3;
    double bend = 0.0, slope = 0.0;
    for (const noise::Octave& octave : field.octaves()) {
        bend += octave.amplitude * octave.frequency * octave.frequency * bounds.second;
        slope += octave.amplitude * octave.frequency;
    }
    return bend * distance + 2.0 * errors.slope * slope + 16.0 * 0x1p-24;
}

std::vector<Row> same_picture(const std::string& scene_name, const Motion& motion, const Settings& settings, Random&) {
    SceneSpec base = base_spec(scene_name, false);
    const int width = settings.trials(384, 96);
    base.sets.push_back(fmt::format("film.width={}", width));
    base.sets.push_back(fmt::format("film.height={}", width * 9 / 16));
    RayJury at_rest(base, settings), elsewhere(moved(base, motion), settings);
    const Picture a = picture(at_rest), b = picture(elsewhere);
    const Displacement displacement(elsewhere.scene(), motion.scale);
    const bool height_field = scene_name == "terrain";
    Worst radiance, ratio;
    int flips = 0, different = 0;
    double largest = 0.0;
    for (std::size_t i = 0; i < a.rays.size() && !settings.cancelled(); ++i) {
        const auto replay = [&] {
            const WorldRay pixel{.pixel = glm::ivec2(static_cast<int>(i) % width, static_cast<int>(i) / width)};
            return elsewhere.replay(pixel);
        };
        different += a.radiance[i] != b.radiance[i];
        // The moved picture's hit must keep both promises on the ray at rest.
        const double shift = displacement.at(a.hits[i].s + b.hits[i].s);
        at_rest.judge_claim(a.rays[i], b.hits[i], shift, replay);
        const double delta = a.rays[i].delta0 + a.rays[i].delta_slope * a.hits[i].s;
        const double apart = std::abs(a.hits[i].s - b.hits[i].s) + shift;
        if (a.hits[i].state != b.hits[i].state || apart > 2.0 * delta + shift) {
            ++flips;
            continue;
        }
        if (!height_field || a.hits[i].state != trace::HitState::hit) continue;
        // Each normal is of a point within delta of its hit.
        const double bound = radiance_bound(at_rest.field(), apart + 2.0 * delta);
        largest = std::max(largest, bound);
        ratio.see(std::abs(a.radiance[i] - b.radiance[i]) / bound, replay);
        radiance.see(std::abs(a.radiance[i] - b.radiance[i]), replay);
    }
    const std::string name = scene_name + " " + motion.name;
    const double pixels = static_cast<double>(a.rays.size());
    std::vector<Row> rows = {at_rest.rows(name + ", its hits on the rays at rest").front()};
    if (motion.exact) {
        rows.push_back(check(name + ": pixels that are not the same bits", static_cast<double>(different), 0.0,
                             "pixels", fmt::format("of {}", pixels)));
    } else {
        rows.push_back(information(name + ": hits that are another silhouette's", 100.0 * flips / pixels, "% of pixels",
                                   fmt::format("{} of {}", flips, pixels)));
    }
    if (height_field && !motion.exact) {
        rows.push_back(check(name + ": radiance, share of its bound", ratio.value(), 1.0, "of bound",
                             fmt::format("largest difference {:.3g} of radiance up to 1; bounds up to {:.3g}; {}",
                                         radiance.value(), largest, ratio.where())));
    }
    return rows;
}

// With shadows and the filter on, as users see it: information.
std::vector<Row> with_shadows(const Motion& motion, const Settings& settings, Random&) {
    SceneSpec base = base_spec("terrain", true);
    base.sets.insert(base.sets.end(), {"film.width=160", "film.height=90"});
    const RayJury at_rest(base, settings), elsewhere(moved(base, motion), settings);
    const Picture a = picture(at_rest), b = picture(elsewhere);
    int different = 0;
    for (std::size_t i = 0; i < a.radiance.size(); ++i)
        different += std::abs(a.radiance[i] - b.radiance[i]) > 1.0 / 255.0;
    return {information("terrain " + motion.name + ", shadows: pixel centres off by more than 1/255",
                        100.0 * different / static_cast<double>(a.radiance.size()), "% of pixels",
                        fmt::format("{} of {}", different, a.radiance.size()))};
}

// 2^20 base cells are 2^22 surface units at a frequency of 1/4.
const std::vector<Motion>& motions() {
    static const std::vector<Motion> table = {
        {"moved by 2^20 cells on each axis", 1.0, {}, glm::dvec3(0x1p22, -0x1p22, 0x1p22), true},
        {"moved by an odd distance of 2^20 cells", 1.0, {}, glm::dvec3(4194303.1, -4000000.7, 3999999.3), false},
        {"scaled by 2^20", 0x1p20, {}, {}, true},
        {"scaled by 2^-20", 0x1p-20, {}, {}, true},
        {"scaled by 1/3", 1.0 / 3.0, {}, {}, false},
        {"turned by 90 degrees about y", 1.0, {0.0, 90.0, 0.0}, {}, false},
        {"turned by 90 degrees about each axis", 1.0, {90.0, 90.0, 90.0}, {}, false},
        {"turned by 17 degrees about each axis", 1.0, {17.0, 17.0, 17.0}, {}, false},
        {"turned by 17, scaled by 2^10, moved",
         0x1p10,
         {17.0, 17.0, 17.0},
         glm::dvec3(4194303.1, -4000000.7, 3999999.3),
         false},
    };
    return table;
}

}  // namespace

void add_invariance_cases(std::vector<Case>& cases) {
    for (const char* name : {"terrain", "hyperterrain", "planet", "isosurface"}) {
        for (const Motion& motion : motions()) {
            cases.push_back({"invariance", std::string(name) + " " + motion.name,
                             [=](const Settings& s, Random& r) { return same_picture(name, motion, s, r); }});
        }
    }
    for (const Motion& motion : motions()) {
        cases.push_back({"invariance", "shadows " + motion.name,
                         [=](const Settings& s, Random& r) { return with_shadows(motion, s, r); }});
    }
}

}  // namespace strata::tools::stability
