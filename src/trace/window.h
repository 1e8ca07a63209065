// Windows: second-order Taylor expansions of the noise, shared by rays that run close together.
//
// In a ball of the noise's domain around its centre (in 2-D: a disc) the sum of all octaves differs from
// value + gradient . D + D^T hessian D / 2,  D = x - centre, all of it evaluated in float, by less than `error`
// (window_plan.h). While it is in there a ray takes the polynomial for the noise; where the error keeps it from telling
// f's sign it goes on without. Normals are of the noise itself.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace strata::trace {

struct Window {
    glm::dvec3 centre{0.0};

    // Distances between which the rays that it was made for are in the ball.
    double from = 0.0;
    double to = 0.0;

    std::uint32_t octaves = 0;
    std::int32_t next = 0;  // the one further along the same rays, counted from here; 0: none
    float error = 0.0f;
    float value = 0.0f;
    glm::vec3 gradient{0.0f};
    std::array<float, 6> hessian{};  // xx, yy, zz, xy, xz, yz

    const Window* after() const { return next == 0 ? nullptr : this + next; }
};

}  // namespace strata::trace
