// Skylight by brute force, in double and one band at a time: rays in Cartesian coordinates about the Earth's centre,
// small steps, no table but the sun's optical depth, no split of directions or of haze. Shares nothing with
// shaders_cpu/daylight but the meaning of its parameters; coefficients are computed anew from the sources named there.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace daylight_oracle {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kEarth = 6371e3;
inline constexpr double kTop = 6471e3;

struct Air {
    double rayleigh, haze, haze_albedo, haze_height, forward, ozone, albedo;  // coefficients per metre

    double air_density(double h) const {
        return h < 11e3 ? std::pow(288.15 - 0.0065 * h, 4.25588) / std::pow(288.15, 4.25588)
                        : 0.297076 * std::exp(-(h - 11e3) / 6341.6);
    }
    double haze_density(double h) const { return std::exp(-h / haze_height); }
    double extinction(double h) const {
        const double ozone_density = h < 10e3 || h > 40e3 ? 0.0 : h < 25e3 ? (h - 10e3) / 15e3 : (40e3 - h) / 15e3;
        return rayleigh * air_density(h) + haze * haze_density(h) + ozone * ozone_density;
    }
    double rayleigh_phase(double c) const { return 3.0 / (16.0 * kPi) * (1.0 + c * c); }
    double haze_phase(double c) const {
        return (1.0 - forward * forward) / (4.0 * kPi * std::pow(1.0 + forward * forward - 2.0 * forward * c, 1.5));
    }
    // Scattering coefficient times phase.
    double scattering(double h, double c) const {
        return rayleigh * air_density(h) * rayleigh_phase(c) + haze_albedo * haze * haze_density(h) * haze_phase(c);
    }
};

// Per metre for one wavelength: Bodhaine et al. 1999, eq. 29; Koschmieder; an Angstrom exponent; a triangle of ozone.
inline Air make_air(double nm, double visibility, double forward, double haze_albedo, double exponent,
                    double ozone_cross_section, double albedo) {
    const auto rayleigh = [](double l) {
        const double u = l / 1000.0;
        return 2.5469e25 * 1e-32 * (1.0455996 - 341.29061 / u / u - 0.9023085 * u * u) /
               (1.0 + 0.0027059889 / u / u - 85.968563 * u * u);
    };
    const double haze = std::max(0.0, 3.912 / visibility - rayleigh(550.0)) * std::pow(550.0 / nm, exponent);
    return {rayleigh(nm), haze, haze_albedo, 1200.0, forward, 300.0 * 2.6868e20 / 15e3 * ozone_cross_section, albedo};
}

// First positive root of |p + t d| = radius, or infinity; `far` asks for the second.
inline double meet(const glm::dvec3& p, const glm::dvec3& d, double radius, bool far) {
    const double b = glm::dot(p, d);
    const double disc = b * b - glm::dot(p, p) + radius * radius;
    if (disc < 0.0) return std::numeric_limits<double>::infinity();
    const double t = far ? -b + std::sqrt(disc) : -b - std::sqrt(disc);
    return t > 0.0 ? t : std::numeric_limits<double>::infinity();
}

// Walks from p along d to the ground or the top in steps that suit the height: use(middle, length). True at the ground.
template <class Use>
bool walk(const glm::dvec3& p, const glm::dvec3& d, double fineness, const Use& use) {
    const double ground = meet(p, d, kEarth, false);
    const double end = std::min(ground, meet(p, d, kTop, true));
    if (!(end < 1e12)) return false;
    for (double t = 0.0; t < end;) {
        const glm::dvec3 q = p + d * t;
        const double r = glm::length(q);
        const double scale = 500.0 + std::max(0.0, r - kEarth);
        const double steep = std::max(std::fabs(glm::dot(q, d)) / r, std::sqrt(2.0 * scale / kEarth));
        const double step = std::min(fineness * scale / steep, end - t);
        use(p + d * (t + 0.5 * step), step);
        t += step > 1e-3 ? step : end;
    }
    return ground < 1e12;
}

// Radiance relative to the sun's irradiance outside, 1/sr.
class Oracle {
  public:
    Oracle(const Air& air, const glm::dvec3& sun) : air_(air), sun_(sun), depth_(kHeights * kUps) {
        for (int i = 0; i < kHeights; ++i)
            for (int k = 0; k < kUps; ++k) {
                const double r = kEarth + height_of(i);
                const double up = up_of(k, r);
                const glm::dvec3 d(std::sqrt(std::max(0.0, 1.0 - up * up)), up, 0.0);
                double depth = 0.0;
                walk({0, r, 0}, d, 0.12, [&](const glm::dvec3& q, double step) {
                    depth += air_.extinction(glm::length(q) - kEarth) * step;
                });
                depth_[i * kUps + k] = depth;
            }
    }

    // What is left of the sun at p. Near the horizon its disc, 0.2666 degrees in radius, is cut into strips.
    double sunlight(const glm::dvec3& p) const {
        const double r = glm::length(p);
        const double up = std::clamp(glm::dot(p, sun_) / r, -1.0, 1.0);
        const double radius = 0.2666 * kPi / 180.0;
        if (up > horizon(r) + 8.0 * radius) return point_light(r, up);
        constexpr int kStrips = 12;
        double sum = 0.0, weights = 0.0;
        for (int k = 0; k < kStrips; ++k) {
            const double y = (2.0 * k + 1.0) / kStrips - 1.0;
            const double weight = std::sqrt(1.0 - y * y);
            sum += weight * point_light(r, std::sin(std::asin(up) + y * radius));
            weights += weight;
        }
        return sum / weights;
    }

    double point_light(double r, double up) const {
        const double level = horizon(r);
        if (up < level) return 0.0;
        const double h = std::clamp(std::sqrt(std::max(0.0, r - kEarth) / 100e3), 0.0, 1.0) * (kHeights - 1);
        const double u = std::sqrt((up - level) / (1.0 - level)) * (kUps - 1);
        const int i = std::min(static_cast<int>(h), kHeights - 2);
        const int k = std::min(static_cast<int>(u), kUps - 2);
        const double fh = h - i, fu = u - k;
        const double* d = &depth_[i * kUps + k];
        return std::exp(-((1 - fh) * ((1 - fu) * d[0] + fu * d[1]) + fh * ((1 - fu) * d[kUps] + fu * d[kUps + 1])));
    }

    double ground(const glm::dvec3& p) const {
        return air_.albedo / kPi * sunlight(p) * std::max(0.0, glm::dot(p, sun_) / glm::length(p));
    }

    // Scattered once, and reflected by the ground but not scattered.
    double single(const glm::dvec3& p, const glm::dvec3& d, double fineness) const {
        const double cosine = glm::dot(d, sun_);
        return along(
            p, d, fineness, [&](const glm::dvec3& q, double h) { return air_.scattering(h, cosine) * sunlight(q); },
            [&](const glm::dvec3& q) { return ground(q); });
    }

    // Scattered or reflected twice, but for light from ground to ground.
    double second(const glm::dvec3& p, const glm::dvec3& d) const {
        return along(
            p, d, 0.25,
            [&](const glm::dvec3& q, double h) {
                double sum = 0.0;
                each_direction(q, [&](const glm::dvec3& from, double solid_angle) {
                    sum += air_.scattering(h, glm::dot(d, from)) * single(q, from, 0.3) * solid_angle;
                });
                return sum;
            },
            [&](const glm::dvec3& q) {
                double sum = 0.0;
                const glm::dvec3 up = glm::normalize(q);
                each_direction(q, [&](const glm::dvec3& from, double solid_angle) {
                    const double cosine = glm::dot(from, up);
                    if (cosine > 0.0) sum += cosine * single(q, from, 0.3) * solid_angle;
                });
                return sum * air_.albedo / kPi;
            });
    }

    // All orders by paths followed backwards; each scattering asks the sun. Mean and its standard error.
    struct Estimate {
        double mean, error;
    };
    Estimate paths(const glm::dvec3& p, const glm::dvec3& d, int count, std::mt19937_64& random) const {
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < count; ++i) {
            const double value = path(p, d, random);
            sum += value;
            squares += value * value;
        }
        const double mean = sum / count;
        return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
    }

  private:
    static constexpr int kHeights = 160;
    static constexpr int kUps = 320;

    static double height_of(int i) { return 100e3 * std::pow(static_cast<double>(i) / (kHeights - 1), 2.0); }
    static double horizon(double r) { return -std::sqrt(std::max(0.0, 1.0 - kEarth * kEarth / r / r)); }
    static double up_of(int k, double r) {
        const double x = static_cast<double>(k) / (kUps - 1);
        return std::min(1.0, horizon(r) + (1.0 - horizon(r)) * x * x + 1e-9);
    }

    template <class Source, class Ground>
    double along(const glm::dvec3& p, const glm::dvec3& d, double fineness, const Source& source,
                 const Ground& end) const {
        double depth = 0.0, light = 0.0;
        glm::dvec3 last = p;
        const bool ground = walk(p, d, fineness, [&](const glm::dvec3& q, double step) {
            const double h = std::max(0.0, glm::length(q) - kEarth);
            const double x = air_.extinction(h) * step;
            light += std::exp(-depth) * source(q, h) * step * (x > 1e-6 ? (1.0 - std::exp(-x)) / x : 1.0);
            depth += x;
            last = q + d * (0.5 * step);
        });
        return ground ? light + std::exp(-depth) * end(last) : light;
    }

    // 16 rings, crowded at the horizon, of 14 directions.
    template <class Use>
    void each_direction(const glm::dvec3& q, const Use& use) const {
        const glm::dvec3 up = glm::normalize(q);
        const glm::dvec3 side =
            glm::normalize(glm::cross(up, std::fabs(up.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1)));
        const glm::dvec3 ahead = glm::cross(side, up);
        const double level = horizon(glm::length(q));
        constexpr int kRings = 8, kAround = 14;
        for (const double reach : {1.0 - level, -1.0 - level})
            for (int k = 0; k < kRings; ++k) {
                const double x = (k + 0.5) / kRings;
                const double c = level + reach * x * x;
                const double s = std::sqrt(std::max(0.0, 1.0 - c * c));
                for (int a = 0; a < kAround; ++a) {
                    const double turn = 2.0 * kPi * (a + 0.25) / kAround;
                    use(up * c + (side * std::cos(turn) + ahead * std::sin(turn)) * s,
                        std::fabs(reach) * 2.0 * x / kRings * 2.0 * kPi / kAround);
                }
            }
    }

    static glm::dvec3 turned(const glm::dvec3& axis, double cosine, double turn) {
        const glm::dvec3 side =
            glm::normalize(glm::cross(axis, std::fabs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1)));
        const double s = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        return axis * cosine + (side * std::cos(turn) + glm::cross(axis, side) * std::sin(turn)) * s;
    }

    double path(glm::dvec3 p, glm::dvec3 d, std::mt19937_64& random) const {
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        double weight = 1.0, light = 0.0;
        for (int event = 0; event < 60; ++event) {
            const double ground = meet(p, d, kEarth, false);
            const double end = std::min(ground, meet(p, d, kTop, true));
            if (!(end < 1e12)) return light;
            // Free flight by tentative collisions, at the density of the lowest point of the stretch ahead.
            double t = 0.0;
            bool hit = false;
            while (!hit && t < end) {
                const double stretch = std::min(end - t, 8e3);
                const double low = std::clamp(-glm::dot(p + d * t, d), 0.0, stretch);
                // Ozone, thickest at 25 km, adds its most.
                const double majorant =
                    air_.extinction(std::max(0.0, glm::length(p + d * (t + low)) - kEarth)) + air_.ozone;
                const double flight = -std::log(1.0 - unit(random)) / majorant;
                if (flight > stretch) {
                    t += stretch;
                    continue;
                }
                t += flight;
                hit = unit(random) * majorant < air_.extinction(std::max(0.0, glm::length(p + d * t) - kEarth));
            }
            p += d * std::min(t, end);
            if (!hit) {
                if (!(ground < 1e12)) return light;
                light += weight * ground_sun(p);
                weight *= air_.albedo;
                p *= (kEarth + 0.01) / glm::length(p);
                d = turned(glm::normalize(p), std::sqrt(unit(random)), 2.0 * kPi * unit(random));
                continue;
            }
            const double h = std::max(0.0, glm::length(p) - kEarth);
            const double air = air_.rayleigh * air_.air_density(h);
            const double haze = air_.haze_albedo * air_.haze * air_.haze_density(h);
            const double all = air_.extinction(h);
            light += weight * air_.scattering(h, glm::dot(d, sun_)) / all * sunlight(p);
            weight *= (air + haze) / all;
            if (event > 4) {  // Russian roulette
                if (unit(random) > 0.7) return light;
                weight /= 0.7;
            }
            double cosine;
            if (unit(random) * (air + haze) < air) {
                do cosine = 2.0 * unit(random) - 1.0;
                while (2.0 * unit(random) > 1.0 + cosine * cosine);
            } else {
                const double g = air_.forward;
                const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * unit(random));
                cosine = g > 1e-6 ? (1.0 + g * g - s * s) / (2.0 * g) : 2.0 * unit(random) - 1.0;
            }
            d = turned(d, cosine, 2.0 * kPi * unit(random));
        }
        return light;
    }
    double ground_sun(const glm::dvec3& p) const { return ground(p); }

    Air air_;
    glm::dvec3 sun_;
    std::vector<double> depth_;
};

}  // namespace daylight_oracle
