// The wheels of figure 8.
#pragma once

#include "src/scene/scene.h"

namespace strata::tools::figures {

inline constexpr double kWheelFps = 25;
inline constexpr double kWheelOpen_s = 0.033;
inline constexpr int kWheelSpokes = 12;

// How often a spoke passes: 2 Hz is seen as it is; 23 Hz, between fps/2 and fps, as 23 - 25 = -2 Hz.
inline constexpr double kSlow_Hz = 2;
inline constexpr double kFast_Hz = 23;

inline constexpr int kWheelFrames[] = {0, 2};

// The built-in wheel with spokes passing `spoke_Hz` times a second, filtered in time by the B-spline of order
// `time_order`; N = 10, m = 4.
scene::Scene wheel_scene(double spoke_Hz, int time_order, int frame, int side);

// What a time filter of this order leaves of the spokes' first harmonic: |sinc(f s)|^l.
double wheel_gain(double spoke_Hz, int time_order);

}  // namespace strata::tools::figures
