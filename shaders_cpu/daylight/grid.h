// Places in tables.
#pragma once

#include <algorithm>
#include <cmath>

namespace strata::shaders {

// Between node `index` and the next one, `fraction` of the way.
struct Cell {
    int index = 0;
    float fraction = 0.0f;
};

// The cell of a position in [0,1] among `nodes` even nodes; positions outside are moved to the ends.
inline Cell cell_of(double position, int nodes) {
    const double place = std::clamp(position, 0.0, 1.0) * (nodes - 1);
    const int index = std::min(static_cast<int>(place), nodes - 2);
    return {index, static_cast<float>(place - index)};
}

inline double fourth_root(double x) { return std::sqrt(std::sqrt(x)); }

// Exact at a, and where a equals b.
template <class Value>
Value blend(const Value& a, const Value& b, float fraction) {
    return a + (b - a) * fraction;
}

}  // namespace strata::shaders
