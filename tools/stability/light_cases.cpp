// Daylight, air, fog and rough ground at the ends of their ranges.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "shaders_cpu/daylight/daylight.h"
#include "shaders_cpu/media/fog.h"
#include "shaders_cpu/rough_lobe.h"
#include "tools/stability/case.h"
#include "tools/stability/light_support.h"

namespace strata::tools::stability {

namespace {

double any_distance(Random& random) {
    return unit(random) < 0.1 ? kInfinity : std::pow(10.0, 16.0 * unit(random) - 8.0);
}

// Light is no number below 0, and air lets through between nothing and all of it, exactly; over no distance it does
// nothing. What the sun gives outside the air is the most it gives anywhere.
std::vector<Row> daylight(const Settings& settings, Random& random) {
    Worst light, passed, nearest, sun;
    const shaders::Daylight outside(shaders::Atmosphere{}, towards(90.0 * kRadian, 0.0), shaders::kAirTop);
    const glm::dvec3 most = outside.sun_illuminance(shaders::kAirTop);
    for (const double elevation : {-90.0, -6.0, -0.2666, 0.0, 0.01, 90.0}) {
        for (const double height : {0.0, 2.0, 10e3, 100e3}) {
            if (settings.cancelled()) return {};
            const shaders::Daylight day({}, towards(elevation * kRadian, 1.0), height);
            const auto where = [&] { return fmt::format("sun at {} degrees, eye at {} m", elevation, height); };
            sun.see(day.sun_illuminance(height).r / most.r, where);
            for (int i = 0; i < settings.trials(3000, 300); ++i) {
                const glm::dvec3 d = any_direction(random);
                const double distance = any_distance(random);
                const auto there = [&] {
                    return fmt::format("{}, direction {} {} {}, {} m", where(), d.x, d.y, d.z, distance);
                };
                light.see(
                    std::max({ill(day.sky_radiance(d)), ill(day.sky_irradiance(d)), ill(day.ground_irradiance(d))}),
                    there);
                for (const auto& air : {day.aerial(height, d, distance), day.aerial_from_observer(d, distance)}) {
                    light.see(ill(air.inscatter), there);
                    for (int c = 0; c < 3; ++c) {
                        passed.see(std::max(-air.transmittance[c], air.transmittance[c] - 1.0), there);
                    }
                }
                const auto none = day.aerial_from_observer(d, 0.0);
                nearest.see(glm::length(none.inscatter) + glm::length(none.transmittance - 1.0), there);
            }
        }
    }
    return {check("daylight, sun at -90 to 90 degrees, eye at 0 to 100 km: least light below 0", light, 0.0, "cd/m^2"),
            check("air: what it lets through, beyond [0, 1]", passed, 0.0, ""),
            check("air over no distance: what it changes", nearest, 0.0, ""),
            check("sunlight, of that outside the air", sun, 1.0, "")};
}

// The closed form multiplies six factors: exp (of an argument up to x, whose own rounding it turns into x 2^-53),
// expm1, a quotient, products; the reference integrates in long double by Gauss and Legendre's five points a piece.
std::vector<Row> fog(const Settings& settings, Random& random) {
    constexpr std::array<long double, 3> kPlaces{0.0L, 0.53846931010568309104L, 0.90617984593866399280L},
        kWeights{0.56888888888888888889L, 0.47862867049936646804L, 0.23692688505618908751L};
    Worst off;
    for (int i = 0; i < settings.trials(4000, 400) && !settings.cancelled(); ++i) {
        scene::Scene scene;
        scene.scale.metres = 1.0;
        scene.fog = {.visibility_m = std::pow(10.0, 5.0 * unit(random)),
                     .level_m = 1000.0 * (unit(random) - 0.5),
                     .fall_m = std::pow(10.0, 1.0 + 3.0 * unit(random))};
        const shaders::Fog closed({scene, nullptr});
        const double climb = i % 3 == 0 ? 1e-9 * (unit(random) - 0.5) : std::sin(1.5 * (unit(random) - 0.5));
        const double y = 2000.0 * unit(random);
        // Farther than 100 km fog is not followed.
        const double most = std::min(30.0 * scene.fog.fall_m / std::max(std::abs(climb), 1e-3), 100e3);
        const shaders::MediumRay ray{
            {0.0, y, 0.0}, {std::sqrt(1.0 - climb * climb), climb, 0.0}, most * std::pow(10.0, -6.0 * unit(random))};
        const int pieces = 64;
        long double sum = 0.0L;
        const long double half = 0.5L * static_cast<long double>(ray.distance) / pieces;
        for (int piece = 0; piece < pieces; ++piece) {
            for (int p = -2; p <= 2; ++p) {
                const auto k = static_cast<std::size_t>(std::abs(p));
                const long double s = half * (2.0L * piece + 1.0L + (p < 0 ? -kPlaces[k] : kPlaces[k]));
                const long double at = static_cast<long double>(y) + static_cast<long double>(climb) * s;
                sum += kWeights[k] * half *
                       expl(-(at - static_cast<long double>(scene.fog.level_m)) /
                            static_cast<long double>(scene.fog.fall_m));
            }
        }
        // The visibility's constant, 3.912, has four digits of ln 50: a stated unit, not an error of the sum.
        const long double expected = sum * 3.912L / static_cast<long double>(scene.fog.visibility_m);
        off.see(static_cast<double>(std::abs(static_cast<long double>(closed.depth(ray)) / expected - 1.0L)), [&] {
            return fmt::format("fall {} m, from {} m, climb {:.17g}, {} m", scene.fog.fall_m, y, climb, ray.distance);
        });
    }
    const double bound = (12.0 + 2.0 * 2500.0 / 10.0) * 0x1p-53;  // arguments up to 250, rounded twice
    return {check("even fog's depth along any ray, against quadrature in long double", off, bound, "relative")};
}

// What is set to nothing takes the very path that is taken without it.
std::vector<Row> nothing(const Settings&, Random&) {
    const auto as_it_is = [](scene::Scene&) {};
    return {check("fog of visibility 0 (none), its other keys at odds: pixels that differ",
                  differing("terrain", as_it_is,
                            [](scene::Scene& s) { s.fog = {.visibility_m = 0.0, .level_m = 1e4, .rise_m = 500.0}; }),
                  0.0, "pixels", "terrain at 24x16"),
            check("a sun's disc of radius 0 against the point: pixels that differ",
                  differing("terrain", as_it_is, [](scene::Scene& s) { s.sun.angular_radius_deg = 0.0; }), 0.0,
                  "pixels", "terrain at 24x16")};
}

// Directional albedo of white ground by the midpoint rule, over the fourth root t of light's squared cosine, which puts
// half of the places below a cosine of 1/4, and over azimuths. The lobe has kinks, where s changes sign and where the
// two cosines are equal: there the rule is off by half a step's change of value and slope, (1/400)^2 + (1/200)^2
// times 2.
std::vector<Row> rough_ground(const Settings& settings, Random& random) {
    Worst off, most;
    constexpr int kPlaces = 400, kAzimuths = 200;
    for (int i = 0; i < settings.trials(40, 6) && !settings.cancelled(); ++i) {
        const double roughness = i % 4 == 0 ? 1.0 : unit(random);
        const double out = i % 2 == 0 ? 0.002 + 0.02 * unit(random) : unit(random);
        const shaders::RoughLobe lobe(roughness);
        const glm::dvec3 normal{0.0, 1.0, 0.0}, eye{std::sqrt(1.0 - out * out), out, 0.0};
        const auto where = [&] { return fmt::format("roughness {:.17g}, cosine {:.17g}", roughness, out); };
        double sum = 0.0;
        for (int a = 0; a < kPlaces; ++a) {
            const double t = (a + 0.5) / kPlaces, share = 4.0 * t * t * t;
            for (int b = 0; b < kAzimuths; ++b) {
                const glm::dvec3 light = towards(std::asin(t * t), std::numbers::pi * (b + 0.5) / kAzimuths);
                const double value = lobe(normal, light, eye);
                most.see(value < 0.0 || !std::isfinite(value) ? kInfinity : 0.0, where);
                sum += share * value;
            }
        }
        off.see(std::abs(sum / (kPlaces * kAzimuths) - 1.0), where);
    }
    const double bound = 2.0 * (1.0 / (kPlaces * kPlaces) + 1.0 / (kAzimuths * kAzimuths));
    return {check("white rough ground under even light: how far from white, eye grazing or not", off, bound, ""),
            check("rough ground: reflectance below 0 or without end", most, 0.0, "")};
}

}  // namespace

void add_light_cases(std::vector<Case>& cases) {
    cases.push_back({"light", "daylight", daylight});
    cases.push_back({"light", "fog", fog});
    cases.push_back({"light", "nothing", nothing});
    cases.push_back({"light", "rough ground", rough_ground});
}

}  // namespace strata::tools::stability
