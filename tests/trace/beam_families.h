// Beams that are hard on their tracer, and points of a beam's bundle where f may be low.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "src/trace/beam.h"
#include "tests/trace/ray_families.h"

namespace strata::trace_test {

// Random surfaces beyond random_surface(): 1 to 24 octaves, or none, steep amplitudes, planets from small to large.
inline scene::Surface beam_surface(Random& random, int index) {
    scene::Surface surface = index % 3 == 2 ? random_drifting_surface(random) : random_surface(random);
    surface.kind = support::any_kind(static_cast<std::uint64_t>(index));
    if (index % 5 == 1) {
        surface.octaves = 17 + static_cast<int>(random() % 8);
        surface.gain = std::min(surface.gain, 0.55);
    }
    if (index % 7 == 3) surface.amplitude *= 8.0;
    if (index % 11 == 7) surface.amplitude = 0.0;
    surface.shape<solid::Sphere>().radius = log_uniform(random, 1e-2, 1e4);
    return surface;
}

class BeamFamilies {
  public:
    explicit BeamFamilies(const trace::Field& field) : field_(field) {}

    trace::Beam make(Random& random) const {
        trace::Beam beam;
        if (field_.drifts()) {
            beam.noise_shift = field_.noise_shift(uniform(random, -50.0, 50.0));
            if (random() % 4 != 0) beam.noise_radius = log_uniform(random, 1e-6, 1.0) / field_.surface().frequency;
        }
        const double size = length_scale();
        const glm::dvec3 target = near_point(random);
        beam.origin = target + log_uniform(random, 1e-3, 8.0) * size * unit_vector(random);
        beam.direction =
            glm::normalize(target + 0.1 * size * uniform(random, 0.0, 1.0) * unit_vector(random) - beam.origin);
        beam.limit = uniform(random, 1.0, 40.0) * size;
        widen(random, beam);
        switch (random() % 8) {
            case 0:  // along the vertical
                beam.direction = {0.0, random() % 2 == 0 ? -1.0 : 1.0, 0.0};
                beam.origin = target - log_uniform(random, 1e-3, 3.0) * size * beam.direction;
                break;
            case 1:  // grazing what is near
                beam.direction = glm::normalize(glm::cross(
                    field_.gradient(target, beam.noise_shift) + 1e-3 * unit_vector(random), unit_vector(random)));
                beam.origin = target - uniform(random, 0.0, 3.0) * size * beam.direction;
                break;
            case 2:  // from the thick of it, often from inside
                beam.origin = target;
                beam.direction = unit_vector(random);
                break;
            case 3:  // begins where another ended, or anywhere
                beam.start = log_uniform(random, 1e-4, 1.0) * beam.limit;
                break;
            case 4:  // far from the noise's origin
                if (solid::row_of(field_.surface().kind).is_level) {
                    const double far = std::exp2(uniform(random, 10.0, 31.0));
                    beam.origin += far * glm::dvec3(uniform(random, -1.0, 1.0), 0.0, uniform(random, -1.0, 1.0));
                }
                break;
            case 5:
                if (field_.drifts()) settle_on_level_noise(random, beam);
                break;
            default:
                break;
        }
        // Any hint is only that.
        if (random() % 3 == 0) beam.hint = static_cast<float>(log_uniform(random, 1e-6, 1e6) * size);
        return beam;
    }

    // Of what there is to see.
    double length_scale() const {
        const double ball = field_.extent().ball;
        return std::isfinite(ball) ? std::min(ball, 1e5) : std::max(0.2, 2.0 * field_.amplitude());
    }

  private:
    glm::dvec3 near_point(Random& random) const {
        // Over a smooth base not exactly on it, where double cannot tell the sign of f.
        const double height = uniform(random, -0.3, 1.0) * std::max(field_.amplitude(), 1e-6);
        if (solid::row_of(field_.surface().kind).has_bound) return uniform(random, 0.0, 3.0) * unit_vector(random);
        return solid::over(field_.solid(), 60.0 * unit_vector(random), height);
    }

    // Just over the surface where the noise rises nearly as the base does: f is level there, yet noise that is
    // displaced changes it by about what it is.
    void settle_on_level_noise(Random& random, trace::Beam& beam) const {
        const double over = log_uniform(random, 1e-3, 3e-2) / field_.octaves().back().frequency;
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 100; ++i) {
            glm::dvec3 x = near_point(random);
            for (int k = 0; k < 4; ++k) {
                const glm::dvec3 gradient = field_.gradient(x, beam.noise_shift);
                x -= (field_.value(x, beam.noise_shift) - over) / glm::dot(gradient, gradient) * gradient;
            }
            const double f = field_.value(x, beam.noise_shift);
            const double slope = glm::length(field_.gradient(x, beam.noise_shift));
            if (!(f > 0.5 * over && f < 2.0 * over && slope < least)) continue;
            least = slope;
            beam.noise_radius = f * uniform(random, 0.5, 3.0);
            beam.direction = unit_vector(random);
            beam.radius0 = 0.05 * f;
            beam.origin = x - 0.05 * f * beam.direction;
        }
    }

    // Cones from a point, from a disc, cylinders, and beams without width.
    void widen(Random& random, trace::Beam& beam) const {
        const auto kind = random() % 8;
        if (kind <= 5) beam.spread = log_uniform(random, 1e-5, 0.5);
        if (kind >= 4 && kind != 7) beam.radius0 = log_uniform(random, 1e-6, 0.3) * length_scale();
    }

    const trace::Field& field_;
};

// f about a beam's bundle by the oracle, the noise's displacement fixed to one that the beam allows.
class BundleProbe {
  public:
    BundleProbe(const scene::Surface& surface, const trace::Beam& beam, const glm::dvec3& noise_offset)
        : beam_(beam), oracle_(shape(surface, beam.noise_shift + noise_offset)) {
        const glm::dvec3 d = beam.direction;
        const glm::dvec3 other = std::abs(d.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        across_ = glm::normalize(glm::cross(d, other));
        beside_ = glm::cross(d, across_);
    }

    // Cylindrical coordinates about the axis; share: of the bundle's radius there.
    struct Place {
        double s = 0.0, angle = 0.0, share = 0.0;
        glm::dvec3 x{0.0};
        double f = std::numeric_limits<double>::infinity();
    };

    // The lowest f found at axis coordinates in [from, to): points anywhere, more of them near `to` and at the rim;
    // then downhill from the lowest.
    Place lowest(Random& random, double from, double to, int points, int polish) const {
        Place best;
        for (int i = 0; i < points; ++i) {
            const double back = random() % 2 == 0 ? uniform(random, 0.0, 1.0) : log_uniform(random, 1e-9, 1.0);
            consider(best, to - back * (to - from), uniform(random, 0.0, 2.0 * std::numbers::pi),
                     random() % 4 == 0 ? std::sqrt(uniform(random, 0.0, 1.0)) : 1.0, from, to);
        }
        double step = 0.5;
        for (int i = 0; i < polish; ++i, step *= 0.8) {
            const Place at = best;
            consider(best, at.s + step * uniform(random, -1.0, 1.0) * std::min(to - from, radius(at.s)),
                     at.angle + step * 3.0 * uniform(random, -1.0, 1.0),
                     std::min(1.0, at.share + step * uniform(random, -0.5, 0.5)), from, to);
        }
        return best;
    }

    double radius(double s) const { return beam_.radius0 + beam_.spread * s; }

    // Whether f is above 0, in extended precision where double might not tell.
    bool is_free(const Place& place) const {
        if (place.f > 1e-9 * (1.0 + std::abs(place.x.y))) return true;
        return oracle_.value<long double>({place.x.x, place.x.y, place.x.z}) > 0.0L;
    }

  private:
    static oracle::Shape shape(const scene::Surface& surface, const glm::dvec3& noise_shift) {
        oracle::Shape shape = oracle::shape_of(surface, 1.0);
        shape.drift = {-noise_shift.x, -noise_shift.y, -noise_shift.z};
        return shape;
    }

    // Points whose rounding left the bundle or the range do not count.
    void consider(Place& best, double s, double angle, double share, double from, double to) const {
        s = std::clamp(s, from, to);
        const double r = std::clamp(share, 0.0, 1.0) * radius(s) * (1.0 - 1e-9);
        const glm::dvec3 e = r * (std::cos(angle) * across_ + std::sin(angle) * beside_);
        const glm::dvec3 x = beam_.origin + (s * beam_.direction + e);
        long double dot = 0.0L, square = 0.0L;
        for (int a = 0; a < 3; ++a) {
            const long double away = static_cast<long double>(x[a]) - beam_.origin[a];
            dot += away * beam_.direction[a];
            square += away * away;
        }
        const long double room = static_cast<long double>(beam_.radius0) + beam_.spread * dot;
        if (!(dot >= from && dot < to && room >= 0.0L && square - dot * dot <= room * room)) return;
        const double f = oracle_.value({x.x, x.y, x.z});
        if (f < best.f) best = {s, angle, share, x, f};
    }

    const trace::Beam& beam_;
    oracle::FieldOracle oracle_;
    glm::dvec3 across_, beside_;
};

}  // namespace strata::trace_test
