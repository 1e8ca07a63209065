// A light meter: the exposure that shows a scene's mean brightness as mid grey.
#pragma once

#include "src/scene/scene.h"

namespace strata::render {

// Stops, in steps of a tenth: 2^stops times the geometric mean of the frame's luminances is 0.18, where what is nearly
// black beside the rest (a sky without air) is not counted; without a tone curve no more than keeps 99 % of the frame
// below white. Of the whole frame, whatever part of it and at whatever size it will be rendered: the scene is pictured
// 64 pixels wide, by 4 samples a pixel. 0 for a black picture.
double metered_stops(const scene::Scene& scene);

// Where the scene asks for it (film.metered): adds what is metered to film.exposure and no longer asks, so that the
// picture tells the exposure that it has and is the same rendered again in parts, or as a film.
void take_exposure(scene::Scene& scene);

}  // namespace strata::render
