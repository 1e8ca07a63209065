// What a scene's frame needs of a renderer. The renderer asks here what it may leave out, and `strata explain` tells
// from here what it did leave out, so that the two cannot disagree.
#pragma once

#include "src/scene/scene.h"

namespace strata::scene {

// Whether a drift of the noise changes the surface: a height field's noise does not depend on y, and a surface without
// octaves has no noise.
bool noise_drifts(const Surface& surface);

// What of a scene moves while the frame's shutter is open.
struct Motion {
    bool camera = false;  // along its keys
    bool spin = false;    // of the surface
    bool drift = false;   // of the noise
    bool clouds = false;  // layers of them, in the wind
    bool wheel = false;   // the image-plane pattern

    bool any() const { return camera || spin || drift || clouds || wheel; }
};
Motion motion(const Scene& scene);

// Samples that an estimator takes for a pixel, in one pass: N x N, but for the pixel's centre alone.
int samples_a_pixel(const Sampling& sampling);

// Whether samples are spread over the time that the shutter is open: it is open for longer than an instant, something
// moves meanwhile, and the estimator samples more than the pixel's centre.
bool needs_time_samples(const Scene& scene);

// Whether a shadow can darken a surface: it takes sunlight.
bool needs_shadow_rays(const Scene& scene);

// Whether the sun's light in the fog is found by shadow rays.
bool needs_fog_shafts(const Scene& scene);

// Whether there are clouds at all, and whether some drift.
bool needs_clouds(const Scene& scene);
bool clouds_drift(const Scene& scene);

// Whether the sky's light is found by rays.
bool needs_sky_rays(const Scene& scene);

// Whether there is water over the surface.
bool needs_water(const Scene& scene);

}  // namespace strata::scene
