// What a tracer takes and gives, in the surface's own coordinates.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace strata::trace {

struct Window;

// Steps after which a ray is given up as unresolved.
inline constexpr std::uint32_t kStepLimit = 1u << 20;

// x(s) = origin + s direction, s in [0, limit); direction is of unit length.
//
// delta(s) = delta0 + delta_slope * s is the tolerance: a tracer may pass over a stretch of f < 0 that is no longer,
// and within it of a reported hit lies a point with f <= 0. It must not fall below what double can tell along the ray;
// Placement::to_local sees to that.
struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0};
    glm::dvec3 noise_shift{0.0};  // the noise is evaluated at x + noise_shift: Field::noise_shift at the ray's time
    double limit = 0.0;
    double delta0 = 0.0;
    double delta_slope = 0.0;
    double start = 0.0;              // f > 0 in [0, start) or wherever a bound does not cut it off
    float hint = 0.0f;               // step length to begin with; 0: unknown. Speed only
    const Window* window = nullptr;  // the first of those made for this ray, each of which holds along it
    std::uint32_t step_limit = kStepLimit;
};

enum class HitState : std::uint8_t {
    miss,
    hit,
    unresolved,  // the step limit was reached
    water,       // never a tracer's: no surface lies before the level water, where the ray ends (src/integrate/water.h)
};

struct Hit {
    HitState state = HitState::miss;
    bool on_bound = false;   // on the isosurface's bounding ball or box: its normal applies
    double s = 0.0;          // estimate of the root
    double s_outside = 0.0;  // f > 0 there, s - s_outside <= delta; equal to s where the ray starts inside
    std::uint32_t steps = 0;
    std::uint32_t noise_evaluations = 0;

    // Of f with its first `octaves` octaves alone, at a point within delta of s.
    glm::vec3 gradient{0.0f};
    std::uint32_t octaves = 0;
};

// Octaves that were not evaluated where f was looked at, by what made them needless.
struct LeftOut {
    std::uint64_t too_fine = 0;   // f is above 0 whatever they are, and the step too long for them to lengthen it
    std::uint64_t settled = 0;    // f is below 0 whatever they are
    std::uint64_t in_window = 0;  // a window's polynomial stood for them

    std::uint64_t total() const { return too_fine + settled + in_window; }
    LeftOut& operator+=(const LeftOut& other) {
        too_fine += other.too_fine;
        settled += other.settled;
        in_window += other.in_window;
        return *this;
    }
};

struct TraceCounters {
    std::uint64_t noise_evaluations = 0;
    std::uint64_t executed_lanes = 0;
    std::uint64_t steps = 0;
    LeftOut left_out;  // of rays and beams
};

}  // namespace strata::trace
