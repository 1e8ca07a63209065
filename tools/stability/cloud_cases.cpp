// Clouds that are none, with the eye in their layer, and under a sun at the horizon.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders_cpu/cloud_crossing.h"
#include "shaders_cpu/cloud_scene.h"
#include "tools/stability/case.h"
#include "tools/stability/light_support.h"

namespace strata::tools::stability {

namespace {

constexpr double kAltitude = 2600.0;

scene::Scene cloudy(double sun_elevation_deg) {
    scene::Scene scene;
    scene.scale.metres = 100.0;
    scene.sky.model = scene::SkyModel::daylight;
    scene.sun.direction = towards(sun_elevation_deg * kRadian, 1.0);
    scene.clouds = {{.name = "low", .altitude_m = kAltitude, .coverage = 0.5, .warp_m = 300.0},
                    {.name = "high", .altitude_m = 7000.0, .coverage = 0.9, .depth = 1.0, .edge = 0.1}};
    return scene;
}

// What is set to nothing takes the very path that is taken without it.
std::vector<Row> no_clouds(const Settings&, Random&) {
    const auto clear = [](scene::Scene& s) { s.clouds.clear(); };
    return {check("clouds of coverage 0: pixels that differ from none",
                  differing("clouds", clear,
                            [](scene::Scene& s) {
                                for (auto& layer : s.clouds) layer.coverage = 0.0;
                            }),
                  0.0, "pixels", "clouds at 24x16"),
            check("clouds of depth 0: pixels that differ from none",
                  differing("clouds", clear,
                            [](scene::Scene& s) {
                                for (auto& layer : s.clouds) layer.depth = 0.0;
                            }),
                  0.0, "pixels", "clouds at 24x16")};
}

// A share that is none: below 0, above 1, or no number.
double beyond_share(double share) { return std::isfinite(share) ? std::max(-share, share - 1.0) : kInfinity; }

// The eye from far below to far above a layer, at it and as near to it as numbers are; suns about the horizon.
std::vector<Row> in_a_layer(const Settings& settings, Random& random) {
    Worst light, passed, hidden, sun;
    for (const double elevation : {-6.0, -0.2666, 0.0, 1e-9, 0.01, 90.0}) {
        for (const double over : {-2600.0, -1.0, -1e-9, 0.0, 1e-9, 1.0, 5000.0}) {
            if (settings.cancelled()) return {};
            const scene::Scene scene = cloudy(elevation);
            const glm::dvec3 eye{0.3, (kAltitude + over) / scene.scale.metres, 0.7},
                to_sun = glm::normalize(scene.sun.direction);
            const shaders::DaylightScene daylight(scene, to_sun, eye);
            const shaders::CloudScene clouds(scene, daylight, to_sun);
            for (int i = 0; i < settings.trials(2000, 200); ++i) {
                const glm::dvec3 d = any_direction(random);
                const shaders::MediumRay ray{
                    eye, d, unit(random) < 0.5 ? kInfinity : std::pow(10.0, 8.0 * unit(random) - 3.0), 1e-3};
                const auto where = [&] {
                    return fmt::format(
                        "sun at {} degrees, eye {} m over the layer, direction {} {} {}, {} surface units", elevation,
                        over, d.x, d.y, d.z, ray.distance);
                };
                for (const auto side : {shaders::CloudSide::below, shaders::CloudSide::above}) {
                    const shaders::MediumSegment seen = clouds.along(ray, side);
                    light.see(ill(glm::dvec3(seen.inscatter)), where);
                    for (int c = 0; c < 3; ++c)
                        passed.see(beyond_share(static_cast<double>(seen.transmittance[c])), where);
                }
                hidden.see(beyond_share(clouds.opacity(ray)), where);
                const glm::dvec3 x = eye + glm::dvec3(1e3 * unit(random), unit(random) - 0.5, 1e3 * unit(random));
                sun.see(beyond_share(static_cast<double>(clouds.sunlight(x, to_sun))), where);
            }
        }
    }
    return {check("clouds, eye from below to above a layer and at it: least light below 0", light, 0.0, "radiance"),
            check("what they let through, beyond [0, 1]", passed, 0.0, ""),
            check("what they hide, beyond [0, 1]", hidden, 0.0, ""),
            check("sunlight that they leave, sun at the horizon or not, beyond [0, 1]", sun, 0.0, "")};
}

// A crossing is where it is said to be: r^2 + 2 r climb s + s^2 against the layer's squared radius, in long double.
// With u = 2^-53 and m = r + s, which no term exceeds squared: b and d are within 3 u of themselves, their root's
// argument within 8 u m^2, and the sum of root and b within 6 u m; the residual has the slope 2 m at most in s, and s
// itself 2 more roundings.
std::vector<Row> crossings(const Settings& settings, Random& random) {
    Worst off;
    constexpr double kEarth = 6.371e6;
    for (int i = 0; i < settings.trials(200000, 20000) && !settings.cancelled(); ++i) {
        const double rise = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, 14.0 * unit(random) - 10.0),
                     radius = kEarth + 3000.0 * unit(random);
        const double climb = any_direction(random).y;
        const shaders::CloudCrossings found = shaders::cloud_crossings(radius, climb, rise);
        for (std::size_t k = 0; k < found.count; ++k) {
            const long double r = radius, c = climb, s = found.at[k], up = rise;
            const long double residual = s * s + 2.0L * r * c * s - up * (2.0L * r + up);
            const long double most = r + s;
            off.see(static_cast<double>(std::abs(residual) / (most * most)),
                    [&] { return fmt::format("radius {:.17g}, climb {:.17g}, rise {:.17g}", radius, climb, rise); });
        }
    }
    return {check("where rays cross a layer 1e-10 to 10,000 m away: squared distance, over the Earth's", off,
                  2.0 * 8.0 * 0x1p-53, "relative")};
}

}  // namespace

void add_cloud_cases(std::vector<Case>& cases) {
    cases.push_back({"light", "no clouds", no_clouds});
    cases.push_back({"light", "eye in a layer of clouds", in_a_layer});
    cases.push_back({"light", "crossings of clouds", crossings});
}

}  // namespace strata::tools::stability
