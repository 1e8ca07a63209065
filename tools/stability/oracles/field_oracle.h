// An independent implementation of the surfaces' field f, from the written definitions of the octaves and surfaces.
// Shares no code with the project. Surface-local coordinates; f > 0 is outside.
//
//   terrain       y - sum a_k n(w_k (x, z) + (o_k0, o_k1))
//   hyperterrain  y - sum a_k n(w_k p + o_k)
//   planet        |p| - R - sum a_k n(w_k p + o_k)
//   isosurface    threshold - sum a_k n(w_k p + o_k), within a ball |p| <= r or a box |p_i| <= half_i
//
// With a drift d the noise n at time t is taken at p - d t in place of p; all else stays.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tools/stability/oracles/noise_oracle.h"

namespace strata::oracle {

using Vec = std::array<double, 3>;

enum class Kind { terrain, hyperterrain, planet, isosurface };
inline constexpr std::size_t kShapeKinds = 4;
enum class Container { none, ball, box };

struct Shape {
    Kind kind = Kind::terrain;
    int octaves = 8;
    double lacunarity = 2.0;
    double gain = 0.5;
    double amplitude = 0.6;
    double frequency = 0.5;
    std::uint64_t seed = 1;
    double radius = 10.0;    // planet
    double threshold = 0.0;  // isosurface
    Container container = Container::none;
    Vec container_size{};  // ball: radius first; box: half sizes
    Vec drift{};           // of the noise, a second
    double time = 0.0;     // seconds
    double lift = 0.0;     // added to f
};

struct OracleOctave {
    double amplitude = 0.0;
    double frequency = 0.0;
    Vec offset{};
    std::array<std::uint32_t, 3> key{};
};

// A value of f, or of a partial sum with the same sign, and how far off the sign is certain.
struct Probe {
    double f = 0.0;
    double clear = 0.0;  // f keeps its sign at distances below this
};

// Above the largest value and slope of the noise, in 2-D and 3-D: 0.66187 and 2.07081, 1.03636 and 3.75.
inline constexpr double kMaxValue2 = 0.67, kMaxSlope2 = 2.08, kMaxValue3 = 1.04, kMaxSlope3 = 3.76;

class FieldOracle {
  public:
    explicit FieldOracle(const Shape& shape) : shape_(shape) {
        double a = shape.amplitude, w = shape.frequency;
        for (int k = 0; k < shape.octaves; ++k, a *= shape.gain, w *= shape.lacunarity) {
            octaves_.push_back(make_octave(k, a, w));
        }
        // remaining_[k] >= |sum of the octaves k and finer|.
        remaining_.assign(octaves_.size() + 1, 0.0);
        for (std::size_t k = octaves_.size(); k-- > 0;)
            remaining_[k] = remaining_[k + 1] + max_value() * std::abs(octaves_[k].amplitude);
    }

    const Shape& shape() const { return shape_; }
    const std::vector<OracleOctave>& octaves() const { return octaves_; }

    // f before the intersection with a container.
    template <class Real = double>
    Real value(const Vec& p) const {
        Real f = base<Real>(p);
        for (std::size_t k = 0; k < octaves_.size(); ++k) f -= octave<Real>(k, p);
        return f;
    }

    template <class Real = double>
    Real octave(std::size_t k, const Vec& p) const {
        const OracleOctave& o = octaves_[k];
        const auto at = [&](std::size_t axis, std::size_t lattice_axis) {
            const Real drifted = Real(p[axis]) - Real(shape_.drift[axis]) * Real(shape_.time);
            return Real(o.frequency) * drifted + Real(o.offset[lattice_axis]);
        };
        if (shape_.kind == Kind::terrain) return Real(o.amplitude) * noise2<Real>(o.key, at(0, 0), at(2, 1));
        return Real(o.amplitude) * noise3<Real>(o.key, at(0, 0), at(1, 1), at(2, 2));
    }

    template <class Real = double>
    Real base(const Vec& p) const {
        const Real lift = Real(shape_.lift);
        switch (shape_.kind) {
            case Kind::terrain:
            case Kind::hyperterrain:
                return Real(p[1]) + lift;
            case Kind::planet:
                return std::sqrt(Real(p[0]) * Real(p[0]) + Real(p[1]) * Real(p[1]) + Real(p[2]) * Real(p[2])) -
                       Real(shape_.radius) + lift;
            case Kind::isosurface:
                return Real(shape_.threshold) + lift;
        }
        throw std::logic_error("a kind of solid without a base in the oracle");
    }

    // The sign of f at p and how far it is certain along the line p + s direction (unit length). Adds octaves, coarsest
    // first: after K of them |f - partial| <= remaining everywhere, so f cannot change sign until the partial sum,
    // whose Lipschitz constant along the line is L_K, has come within `remaining` of 0.
    Probe probe(const Vec& p, const Vec& direction) const {
        const double noise_speed = shape_.kind == Kind::terrain ? std::hypot(direction[0], direction[2]) : 1.0;
        return probe_with(p, base_slope(direction), noise_speed);
    }

  private:
    // How fast the base changes along the line, at most.
    double base_slope(const Vec& direction) const {
        switch (shape_.kind) {
            case Kind::terrain:
            case Kind::hyperterrain:
                return std::abs(direction[1]);
            case Kind::planet:
                return 1.0;
            case Kind::isosurface:
                return 0.0;
        }
        throw std::logic_error("a kind of solid without a slope in the oracle");
    }

    double max_value() const { return shape_.kind == Kind::terrain ? kMaxValue2 : kMaxValue3; }
    double max_slope() const { return shape_.kind == Kind::terrain ? kMaxSlope2 : kMaxSlope3; }

    OracleOctave make_octave(int k, double amplitude, double frequency) const {
        using detail::scramble;
        const std::uint64_t octave_seed =
            scramble(scramble(shape_.seed) + static_cast<std::uint64_t>(k) * 11400714819323198485u);
        OracleOctave octave{amplitude, frequency, {}, {}};
        for (std::uint64_t axis = 0; axis < 3; ++axis) {
            octave.key[axis] = static_cast<std::uint32_t>(scramble(octave_seed + axis + 1) >> 32);
            const std::uint64_t offset_stream = 0x6F66667365740000u;  // "offset"
            octave.offset[axis] =
                std::ldexp(static_cast<double>(scramble(octave_seed ^ (offset_stream + axis)) >> 11), -53);
        }
        return octave;
    }

    Probe probe_with(const Vec& p, double slope, double noise_speed) const {
        Probe best{base(p), 0.0};
        double partial = best.f;
        for (std::size_t k = 0;; ++k) {
            const double margin = std::abs(partial) - remaining_[k];
            if (margin > 0.0) {
                const double clear = slope > 0.0 ? margin / slope : std::numeric_limits<double>::infinity();
                best.clear = std::max(best.clear, clear);
                best.f = partial;
            }
            if (k == octaves_.size()) break;
            slope += octaves_[k].frequency * std::abs(octaves_[k].amplitude) * max_slope() * noise_speed;
            // No later margin exceeds this one plus twice what remains, and slopes only grow.
            if (margin > 0.0 && margin + 2.0 * remaining_[k] <= best.clear * slope) return best;
            partial -= octave(k, p);
        }
        if (best.clear == 0.0) best.f = partial;
        return best;
    }

    Shape shape_;
    std::vector<OracleOctave> octaves_;
    std::vector<double> remaining_;
};

// The part [begin, end] of the ray p + s direction, s in [0, limit], within the container; begin > end if none.
struct Span {
    double begin = 0.0;
    double end = 0.0;
};

inline Span clip(const Shape& shape, const Vec& p, const Vec& direction, double limit) {
    Span span{0.0, limit};
    if (shape.container == Container::ball) {
        long double dot = 0, direction2 = 0, norm2 = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            dot += static_cast<long double>(p[a]) * direction[a];
            direction2 += static_cast<long double>(direction[a]) * direction[a];
            norm2 += static_cast<long double>(p[a]) * p[a];
        }
        const long double r = shape.container_size[0];
        const long double discriminant = dot * dot - direction2 * (norm2 - r * r);
        if (discriminant < 0) return {1.0, 0.0};
        const long double root = std::sqrt(discriminant);
        span.begin = std::max(span.begin, static_cast<double>((-dot - root) / direction2));
        span.end = std::min(span.end, static_cast<double>((-dot + root) / direction2));
    } else if (shape.container == Container::box) {
        for (std::size_t a = 0; a < 3; ++a) {
            const double half = shape.container_size[a];
            if (direction[a] == 0.0) {
                if (std::abs(p[a]) > half) return {1.0, 0.0};
                continue;
            }
            const double s0 = (-half - p[a]) / direction[a], s1 = (half - p[a]) / direction[a];
            span.begin = std::max(span.begin, std::min(s0, s1));
            span.end = std::min(span.end, std::max(s0, s1));
        }
    }
    return span;
}

}  // namespace strata::oracle
