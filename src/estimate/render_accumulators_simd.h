// The kernel of PixelAccumulators. It multiplies and adds pixel by pixel, unfused, so that every SIMD target gives the
// same bits.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "src/estimate/estimator_weights.h"
#include "src/film/film.h"

namespace strata::estimate {

inline constexpr int kChannels = 4;  // red, green, blue, weight; or three components of a channel beside colour

// The samples of one screen cell.
struct CellSamples {
    glm::ivec2 cell;
    std::span<const float> fraction_u, fraction_v;
    std::span<const glm::vec3> radiance;
};

// Rows of sums by kChannels for the window's pixels, used in rotation.
struct AccumulatorRows {
    film::Rect window;
    int rows;
    std::size_t stride;  // doubles from row to row
    double* sums;

    int slot(int y) const { return (y - window.y0) % rows; }
    int wrapped(int slot) const { return slot < rows ? slot : slot - rows; }
    double* at(int x, int slot) const {
        return sums + static_cast<std::size_t>(slot) * stride + static_cast<std::size_t>((x - window.x0) * kChannels);
    }
};

// Adds each sample, in order, to the pixels of columns [x0,x1) within the window that see it.
void add_cell(const BsplineWeights& weights, const CellSamples& samples, const AccumulatorRows& rows, int x0, int x1);

}  // namespace strata::estimate
