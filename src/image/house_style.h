// One look for every figure: sizes in pixels of the finished picture, legible at 100 %, on white.
#pragma once

#include "src/image/canvas.h"

namespace strata::image::house {

inline constexpr int kTitle_px = 20;
inline constexpr int kLabel_px = 16;
inline constexpr int kNote_px = 13;  // captions, numbers of scales: the smallest that reads well

inline constexpr int kMargin = 16;  // around everything
inline constexpr int kGap = 10;     // between panels
inline constexpr int kPad = 5;      // between a panel and its label

inline constexpr Colour kPaper{1.0f, 1.0f, 1.0f};
inline constexpr Colour kInk{0.11f, 0.11f, 0.13f};    // 16:1 on paper
inline constexpr Colour kMuted{0.36f, 0.37f, 0.40f};  // 6:1 on paper
inline constexpr Colour kRule{0.62f, 0.63f, 0.66f};   // frames around panels
inline constexpr Colour kMark{0.84f, 0.37f, 0.0f};    // vermilion of Okabe and Ito's colour-blind safe set
inline constexpr Colour kMark2{0.0f, 0.45f, 0.70f};   // blue of the same set

}  // namespace strata::image::house
