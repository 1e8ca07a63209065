// Level water seen from along it, without wind, and with the eye at its level.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders_cpu/water_optics.h"
#include "shaders_cpu/water_waves.h"
#include "tools/stability/case.h"
#include "tools/stability/light_support.h"

namespace strata::tools::stability {

namespace {

constexpr double kGrazing = 0.01 * kRadian;  // a lake's far shore, a kilometre away from an eye 17 cm over it

// Elevations of an eye over water: the grazing one, and any below it.
double any_grazing(Random& random, int i) {
    return i % 8 == 0 ? kGrazing : kGrazing * std::pow(10.0, -9.0 * unit(random));
}

// With u = 2^-53: the cosine b under water is within 3.5 u and n b within 6 u; the ratios' numerators and denominators
// are within 8 u and the latter at least 0.88, which makes 20 u a ratio, 41 u its square, and as much their mean.
// Snell's law holds for what is refracted but for its length, 4 roundings of a norm and 2 of a quotient; out of water,
// the squared height is 1 less a square that is within 12 u of the exact one, from both sides.
std::vector<Row> grazing(const Settings& settings, Random& random) {
    Worst mirrored, snell, back;
    constexpr long double kIndex = static_cast<long double>(shaders::kWaterIndex);
    for (int i = 0; i < settings.trials(200000, 20000) && !settings.cancelled(); ++i) {
        const double elevation = any_grazing(random, i);
        const glm::dvec3 down = towards(-elevation, 2.0 * std::numbers::pi * unit(random));
        const auto where = [&] {
            return fmt::format("{:.17g} degrees, {} {} {}", elevation / kRadian, down.x, down.y, down.z);
        };
        const long double in = -static_cast<long double>(down.y);
        const long double below = std::sqrt(1.0L - (1.0L - in * in) / (kIndex * kIndex));
        const long double across = (in - kIndex * below) / (in + kIndex * below);
        const long double along = (below - kIndex * in) / (below + kIndex * in);
        const long double share = 0.5L * (across * across + along * along);
        mirrored.see(static_cast<double>(std::abs(static_cast<long double>(shaders::fresnel(-down.y)) - share)), where);
        const glm::dvec3 under = shaders::refracted(down, {0.0, 1.0, 0.0});
        const glm::dvec2 bent = glm::dvec2(under.x, under.z) * shaders::kWaterIndex - glm::dvec2(down.x, down.z);
        snell.see(under.y < 0.0 ? glm::length(bent) : kInfinity, where);
        const glm::dvec3 out = shaders::out_of_water(-under);
        back.see(std::abs(out.y * out.y - down.y * down.y), where);
    }
    return {check("Fresnel's share at 0.01 degrees and below, against long double", mirrored, 41.0 * 0x1p-53, ""),
            check("Snell's law for what is refracted there: sines' difference", snell, 8.0 * 0x1p-53, ""),
            check("out of the water again: squared height", back, 24.0 * 0x1p-53, "")};
}

// A facet that is drawn is one that is seen: its normal is within a right angle of the eye, but for roundings of slopes
// of at most 10 and of the sums, 4 of them. A wave that turns its back to the eye by more than three deviations of its
// ripples is taken to be turned by no more, so that something is seen: of those, how far, is told. None is without
// area, and what waves mirror of a beam is finite.
std::vector<Row> waves_from_along(const Settings& settings, Random& random) {
    Worst turned, behind, area, beam;
    for (const double wind : {0.01, 1.0, 5.0, 20.0}) {
        const shaders::WaterWaves waves(wind, 2.0);
        for (int i = 0; i < settings.trials(20000, 2000) && !settings.cancelled(); ++i) {
            const double elevation = any_grazing(random, i), azimuth = 2.0 * std::numbers::pi * unit(random);
            const glm::dvec3 to_eye = towards(elevation, azimuth);
            const glm::dvec3 x{1e4 * unit(random), 0.0, 1e4 * unit(random)};
            const double footprint = std::pow(10.0, 6.0 * unit(random) - 3.0);
            const auto where = [&] {
                return fmt::format("wind {} m/s, {:.17g} degrees, at {} {}, footprint {}", wind, elevation / kRadian,
                                   x.x, x.z, footprint);
            };
            const shaders::WaveSlopes slopes = waves.at(x, footprint);
            const shaders::VisibleFacets facets(slopes, to_eye);
            const double u = std::max(unit(random), 0x1p-53), v = std::max(unit(random), 0x1p-53);
            const glm::dvec2 slope = facets.draw(u, v);
            const double to_mean = to_eye.y - glm::dot(slopes.mean, glm::dvec2(to_eye.x, to_eye.z));
            const bool is_behind =
                to_mean < -3.0 * std::sqrt(slopes.variance) * glm::length(glm::dvec2(to_eye.x, to_eye.z));
            (is_behind ? behind : turned).see(-glm::dot(glm::dvec3(-slope.x, 1.0, -slope.y), to_eye), where);
            area.see(facets.area() > 0.0 ? 0.0 : kInfinity, where);
            const glm::dvec3 to_light =
                towards(0.5 * std::numbers::pi * unit(random), 2.0 * std::numbers::pi * unit(random));
            const double radius = i % 2 == 0 ? 0.0 : 0.00465;
            const double sent = shaders::mirrored_beam(slopes, to_eye, to_light, radius);
            beam.see(std::isfinite(sent) ? -sent : kInfinity, where);
        }
    }
    return {check("waves seen from along the water: how far a facet that is drawn is turned away", turned,
                  40.0 * 0x1p-53, ""),
            information("waves that turn their back to the eye: how far a facet of theirs is turned away", behind, ""),
            check("waves seen from along the water: facets without area", area, 0.0, ""),
            check("a beam that they mirror: no number, or below 0", beam, 0.0, "")};
}

// What is set to nothing takes the very path that is taken without it; without wind there is not the least slope.
std::vector<Row> still_water(const Settings& settings, Random& random) {
    Worst slopes;
    const shaders::WaterWaves calm(0.0, 8.0);
    for (int i = 0; i < settings.trials(1000, 100); ++i) {
        const glm::dvec3 x{1e6 * unit(random), 0.0, 1e6 * unit(random)};
        const shaders::WaveSlopes at = calm.at(x, std::pow(10.0, 12.0 * unit(random) - 6.0));
        slopes.see(glm::length(at.mean) + at.variance, [&] { return fmt::format("at {} {}", x.x, x.z); });
    }
    const auto dry = [](scene::Scene& s) { s.water.present = false; };
    return {check("no wind: slopes and their variance", slopes, 0.0, ""),
            check("water that is not present, its other keys at odds: pixels that differ",
                  differing("lake", dry,
                            [](scene::Scene& s) { s.water = {.present = false, .level_m = 1e4, .wind_m_s = 30.0}; }),
                  0.0, "pixels", "lake at 24x16"),
            check("water a kilometre below the ground: pixels that differ",
                  differing(
                      "terrain",
                      [](scene::Scene& s) {
                          s.scale.metres = 1.0;
                          s.camera.far = 100.0;
                      },
                      [](scene::Scene& s) {
                          s.scale.metres = 1.0;
                          s.water = {.present = true, .level_m = -1000.0, .wind_m_s = 3.0};
                          s.camera.far = 100.0;
                      }),
                  0.0, "pixels", "terrain at 24x16")};
}

// From below the level there is no face to be seen; from as little over it as a number tells, there is.
std::vector<Row> at_the_level(const Settings& settings, Random&) {
    Worst light, open;
    for (const double over : {-1e-6, -1e-16, 0.0, 1e-300, 1e-16, 1e-12, 1e-9, 1e-6}) {
        for (const double wind : {0.0, 3.0}) {
            if (settings.cancelled()) return {};
            const auto lower = [&](scene::Scene& s) {
                s.camera.position.y = s.water.level_m / s.scale.metres + over;
                s.camera.look_at.y = s.camera.position.y;
                s.water.wind_m_s = wind;
            };
            const SmallPicture picture = small_picture("lake", lower);
            const auto where = [&] { return fmt::format("{} surface units over the level, wind {} m/s", over, wind); };
            for (const glm::vec3& pixel : picture.pixels) light.see(ill(glm::dvec3(pixel)), where);
            open.see(static_cast<double>(picture.counters.unresolved_rays), where);
        }
    }
    return {check("eye at the water's level, and next to it: pixels that are no light", light, 0.0, "radiance"),
            check("eye at the water's level, and next to it: rays that are not settled", open, 0.0, "rays")};
}

}  // namespace

void add_water_cases(std::vector<Case>& cases) {
    cases.push_back({"light", "water from along it", grazing});
    cases.push_back({"light", "waves from along them", waves_from_along});
    cases.push_back({"light", "still water", still_water});
    cases.push_back({"light", "eye at the water's level", at_the_level});
}

}  // namespace strata::tools::stability
