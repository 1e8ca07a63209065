// The pictures that estimators should arrive at: image functions convolved with the separable B-spline n_m, worked out
// without samples. Nothing here is shared with the estimators: the splines are the exact ones of src/filter/bspline.h,
// where estimators use tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/scene/scene.h"

namespace strata::tools::converge {

struct Truth {
    std::vector<double> grey;  // row by row from the window's top left
    double error = 0;          // no pixel is off by more; the rounding of radiance to float not included
    std::string how;           // for the reader of a report
};

// Whether exact_picture() may have an answer.
bool has_exact_picture(const scene::Scene& scene);

// The pixels of a window of an edge, zone plate, checker, constant or ramp under the B-spline of order m in [1,100].
// Nothing for other images, and for patterns so fine that the answer would take minutes.
std::optional<Truth> exact_picture(const scene::Scene& scene, int m, const film::Rect& window);

// P(Z <= d) where Z = X cos + Y sin, X and Y distributed as the centred n_m: the white share of a pixel whose centre is
// d px inside an edge of that direction. By Gauss-Legendre quadrature on the pieces of the splines, where it is exact.
double edge_coverage(int m, double angle_deg, double d);

std::optional<Truth> exact_zoneplate(const scene::Zoneplate& zoneplate, const scene::Film& film, int m,
                                     const film::Rect& window);
std::optional<Truth> exact_checker(const scene::Checker& checker, const scene::Film& film, int m,
                                   const film::Rect& window);

}  // namespace strata::tools::converge
