// A plane displaced by noise in space, which makes overhangs, arches and caves.
#ifndef STRATA_SOLID_DISPLACED_PLANE_H_
#define STRATA_SOLID_DISPLACED_PLANE_H_

#include <string_view>

#endif

#include "src/solid/plane.h"

#ifndef STRATA_SOLID_DISPLACED_PLANE_
#define STRATA_SOLID_DISPLACED_PLANE_
namespace strata::solid {

struct DisplacedPlane : Plane {
    static constexpr std::string_view kName = "hyperterrain";
    static constexpr std::string_view kMeaning = "y = 3-D sum";
    static constexpr int kDimensions = 3;
};

}  // namespace strata::solid
#endif
