// Ground without overhangs: one height over each point of the plane.
#ifndef STRATA_SOLID_HEIGHT_FIELD_H_
#define STRATA_SOLID_HEIGHT_FIELD_H_

#include <string_view>

#endif

#include "src/solid/plane.h"

#ifndef STRATA_SOLID_HEIGHT_FIELD_
#define STRATA_SOLID_HEIGHT_FIELD_
namespace strata::solid {

struct HeightField : Plane {
    static constexpr std::string_view kName = "terrain";
    static constexpr std::string_view kMeaning = "y = 2-D sum";
    static constexpr int kDimensions = 2;
};

}  // namespace strata::solid
#endif
