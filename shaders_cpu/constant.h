// One grey everywhere: any estimator whose weights sum to 1 renders it without error.
//
//   value   linear radiance   0.5
//
//   [constant]
//   value = 0.5
#pragma once

#include "src/scene/scene.h"

namespace strata::shaders {

// Linear grey at (u, v) pixels of a width x height frame: the same everywhere and always.
inline float constant(const scene::Constant& parameters, int /*width*/, int /*height*/, double /*u*/, double /*v*/,
                      double /*t*/) {
    return static_cast<float>(parameters.value);
}

}  // namespace strata::shaders
