// Where the first hits of rays that share windows (window.h) lie, in closed form.
//
// Along a ray a window makes of f a parabola q with |f - q| <= e. Up to the first root of q - e the ray is free, and at
// the first root of q + e it has certainly entered the surface. The two bracket the hit, however large e is; a few
// evaluations of f itself then find it (landing.h).
#pragma once

#include <cstdint>
#include <span>

#include "src/trace/field.h"
#include "src/trace/ray.h"
#include "src/trace/trace_plan.h"
#include "src/trace/window.h"

namespace strata::trace {

// Rays [first, last) of a batch, the first of whose windows is given; nullptr: they have none.
struct WindowedRays {
    std::size_t first = 0;
    std::size_t last = 0;
    const Window* window = nullptr;
};

enum class BracketState : std::uint8_t {
    open,     // free up to `outside`, nothing is known of what follows
    bracket,  // and somewhere in (outside, inside] lies a point with f <= 0
    miss,     // free up to its end
};

// What is known of one ray.
struct Bracket {
    BracketState state = BracketState::open;
    double outside = 0.0;
    double inside = 0.0;
    double guess = 0.0;  // of the root, within [outside, inside]
};

class Bracketer {
  public:
    explicit Bracketer(const Field& field) : field_(field), half_curvature_(half_curvature(field)) {}

    // brackets: of each ray. A ray's bracket depends on that ray and its windows alone.
    void bracket(std::span<const Ray> rays, const WindowedRays& group, std::span<Bracket> brackets) const;

    // Bound of half the second derivative of the base along any ray down to where all is solid, whatever the relief;
    // infinite where there is none.
    static double half_curvature(const Field& field);

  private:
    const Field& field_;
    double half_curvature_;
};

}  // namespace strata::trace
