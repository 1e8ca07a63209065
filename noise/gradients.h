// The gradient vectors that a corner's hash selects.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace strata::noise {

// 3-D: the twelve edge directions of the cube, |g| = sqrt 2, four of them twice (Perlin 2002), by (hash >> 24) & 15.
inline constexpr std::array<std::array<int, 3>, 16> kGradients3 = {{
    {1, 1, 0},
    {-1, 1, 0},
    {1, -1, 0},
    {-1, -1, 0},
    {1, 0, 1},
    {-1, 0, 1},
    {1, 0, -1},
    {-1, 0, -1},
    {0, 1, 1},
    {0, -1, 1},
    {0, 1, -1},
    {0, -1, -1},
    {1, 1, 0},
    {-1, 1, 0},
    {0, -1, 1},
    {0, -1, -1},
}};

// 2-D: eight directions at 22.5 degrees + multiples of 45, by (hash >> 24) & 7. The components are the cosine and sine
// of 22.5 degrees rounded to eight significant bits, so that a SIMD byte shuffle can build them; |g| = 1.00180.
inline constexpr float kGradientLong = 0.92578125f;
inline constexpr float kGradientShort = 0.3828125f;
inline constexpr std::array<std::array<float, 2>, 8> kGradients2 = {{
    {kGradientLong, kGradientShort},
    {kGradientShort, kGradientLong},
    {-kGradientShort, kGradientLong},
    {-kGradientLong, kGradientShort},
    {-kGradientLong, -kGradientShort},
    {-kGradientShort, -kGradientLong},
    {kGradientShort, -kGradientLong},
    {kGradientLong, -kGradientShort},
}};

}  // namespace strata::noise
