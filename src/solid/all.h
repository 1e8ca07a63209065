// Every kind of solid. A new one is a file like its neighbours here, its #include and its name in the list.
#ifndef STRATA_SOLID_ALL_H_
#define STRATA_SOLID_ALL_H_

#include <variant>

#endif

#include "src/solid/displaced_plane.h"
#include "src/solid/height_field.h"
#include "src/solid/level_set.h"
#include "src/solid/sphere.h"

#ifndef STRATA_SOLID_ALL_
#define STRATA_SOLID_ALL_
namespace strata::solid {

using Solid = std::variant<HeightField, DisplacedPlane, Sphere, LevelSet>;

}  // namespace strata::solid
#endif
