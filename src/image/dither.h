// Eight bits without bands: a value between two codes becomes one or the other by where its pixel lies, so that the
// mean of some pixels is the value.
#pragma once

#include <cmath>

namespace strata::image {

// How many thresholds there are between two codes.
inline constexpr int kDitherLevels = 1024;

// A pixel's place among the thresholds, [0,kDitherLevels). Both factors are odd: any kDitherLevels pixels in a row of
// the frame, or in a column, have each place once. Of all pairs of odd factors these, with their mirror images, keep
// near places farthest apart: of the pixels whose places are less than t apart no two are nearer to each other than
// sqrt(0.287 kDitherLevels / t) pixels, which is found by trying all.
inline int dither_place(int x, int y) {
    const unsigned place = 461u * static_cast<unsigned>(x) + 709u * static_cast<unsigned>(y);
    return static_cast<int>(place % kDitherLevels);
}

// The code of [0,255] for an encoded value of [0,1] at pixel (x,y) of the frame: floor(255 value + s), where the step s
// is one of (k + 1/2) / 1024, k = 0..1023. So
// - it is one of the two codes beside the value, 0 stays 0 and 1 is 255;
// - what is within 1/2048 of a code is that code: a code that was decoded to light comes back, wherever it lies;
// - over any 1024 pixels in a row or column that have the same value the mean of the codes is the value, to 1/2048 of a
//   code, for all steps occur once;
// - a greater value never gets a smaller code, and equal channels of a pixel stay equal: grey is not coloured.
inline int dithered_code(double encoded, int x, int y) {
    const double step = (dither_place(x, y) + 0.5) / kDitherLevels;
    return static_cast<int>(std::floor(encoded * 255.0 + step));
}

}  // namespace strata::image
