// The surface of figures 5, 6 and 7, and the two areas of it that 6 and 7 magnify.
#pragma once

#include <string>

#include "tools/figures/figure.h"

namespace strata::tools::figures {

inline constexpr const char* kSurfaceScene = "planet";
inline constexpr int kSurfaceSamples = 10;  // N of the whole surface and of the best of the details

// The scene at a figure's size; cubic, N = kSurfaceSamples.
scene::Scene surface_scene(Size size);

// The same part of the surface at every size.
film::Rect detail_of_figure_6(Size size);
film::Rect detail_of_figure_7(Size size);

// How one column of a detail differs from another.
struct DetailColumn {
    std::string name;  // in file names
    std::string label;
    bool antialiased = true;
    int N = kSurfaceSamples;
    int m = 4;
};

// Parts, files and comparisons of figure 6 or 7 added to its plan: the first column against the others.
void add_detail(Plan& plan, Size size, const film::Rect& window, std::span<const DetailColumn> columns);

// The strip of magnified details and each of them alone.
void draw_detail(const Plan& plan, Pictures pictures, const std::filesystem::path& folder,
                 std::span<const DetailColumn> columns);

}  // namespace strata::tools::figures
