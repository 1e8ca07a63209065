// The sums of pixels that are still gathering shared samples: a window's columns, and as many of its rows as are in
// work. A pixel adds samples in the order of its cells, row by row, and within a cell by index; strips of columns may
// be worked on by different threads.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "src/estimate/estimator_weights.h"
#include "src/estimate/render_accumulators_simd.h"
#include "src/film/film.h"

namespace strata::estimate {

class PixelAccumulators {
  public:
    // Holds `rows` consecutive rows at a time, each free for reuse once finished.
    PixelAccumulators(const film::Rect& window, const BsplineWeights& weights, int rows);

    // Adds a cell's samples to the pixels of columns [x0,x1) that see it.
    void add(const CellSamples& samples, int x0, int x1) { add_cell(weights_, samples, rows_, x0, x1); }

    // Divides the sums of rows [y0,y1), columns [x0,x1), by their weights into the film, with the weights if it holds
    // them, and sets them to zero.
    void finish(int y0, int y1, int x0, int x1, film::Film& film);

    // The same of sums that are of another channel than colour: `count` <= 3 components, the film's channel values from
    // `first` on.
    void finish_channel(int y0, int y1, int x0, int x1, std::size_t first, std::size_t count, film::Film& film);

  private:
    template <class Set>
    void divide(int y0, int y1, int x0, int x1, const Set& set);

    const BsplineWeights& weights_;
    std::vector<double> sums_;
    AccumulatorRows rows_;
};

}  // namespace strata::estimate
