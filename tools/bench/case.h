// One thing that is measured: a scene's frame, or part of it, rendered by a tracer on a number of threads.
#pragma once

#include <string>

#include "src/integrate/surface_image.h"
#include "src/scene/scene.h"
#include "tools/bench/subset.h"

namespace strata::tools::bench {

struct Case {
    std::string scene_name;  // of the variant: "hyperterrain, 2-D noise"
    scene::Scene scene;
    Subset subset;
    integrate::Tracer tracer = integrate::Tracer::fast;
    int threads = 1;

    // What tells it apart: "hyperterrain 1920x1080 N=10", with what is not usual after it.
    std::string id() const;

    // 16 hexadecimal digits that differ, but for chance, when scene, pixels, tracer or threads do.
    std::string mark() const;
};

}  // namespace strata::tools::bench
