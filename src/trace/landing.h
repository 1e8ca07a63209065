// Finds the hits that brackets (bracket.h) hold, by evaluating f itself with its slope and bend along the ray.
//
// At s, with D the third derivative's bound over 6, f(s + y) differs from the parabola f + f' y + f'' y^2 / 2 by no
// more than D |y|^3. As in a window, the roots of the parabola less and plus that bracket the hit anew, and the
// narrower the bracket, the narrower the next: where D y^2 is below half the slope it shrinks to nothing but rounding.
// Done where it is no longer than the tolerance; the gradient at s, within the tolerance of the hit, is the normal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/trace/bracket.h"
#include "src/trace/field.h"
#include "src/trace/ray.h"
#include "src/trace/trace_plan.h"

namespace strata::trace {

// What bounds f(s + y) about its parabola, from e = 2^-24, E_h the error of a Hessian's entry (noise/float_error.h), S
// and T the bounds of the second and third derivative (noise/bounds.h), over all octaves:
struct LandingPlan {
    explicit LandingPlan(const Field& field);

    const TracePlan& trace;

    // sum a w^3 T / 6.
    float cube = 0.0f;

    // Of half the second derivative: a Hessian's entries are off by E_h each, its norm by 3 E_h at most; products with
    // the direction and sums over up to 32 octaves add fewer than 45 roundings of terms whose absolute values sum up to
    // no more than sqrt(3) S. So 3/2 E_h sum a w^2 + 45/2 sqrt(3) e S sum a w^2.
    float bend_error = 0.0f;

    // Of the base, bracket.h.
    float half_curvature = 0.0f;
    float deepest = -1e30f;  // base values for which half_curvature holds are no lower
};

class Lander {
  public:
    explicit Lander(const Field& field) : field_(field), plan_(field) {}

    // Looks at f once for every ray of `landing`, by index. Those whose hits are found report them, the others'
    // brackets get narrower: these are put into `again`. A hit's steps and noise_evaluations are added to. What a ray
    // finds depends on that ray and its bracket alone.
    void land(std::span<const Ray> rays, std::span<const std::uint32_t> landing, std::span<Bracket> brackets,
              std::span<Hit> hits, std::vector<std::uint32_t>& again, TraceCounters& counters) const;

  private:
    const Field& field_;
    LandingPlan plan_;
};

}  // namespace strata::trace
