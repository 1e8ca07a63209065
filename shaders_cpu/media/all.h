// Every medium: what fills the way from the eye to what it sees. A new one is a file like its neighbours here, its
// #include and its name in the list. A scene has all that are in it, none as a rule or one; of several, each takes what
// the one before it in the list has left.
#pragma once

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/media/daylight_air.h"
#include "shaders_cpu/media/haze.h"
#include "shaders_cpu/medium_segment.h"

namespace strata::shaders {

// along: a ray's first `distance` surface units from the eye in a unit direction, by the axes in which the sky lies.
template <class T>
concept MediumMember = ListMember<T> && requires(const T medium, const glm::dvec3& direction, double distance) {
    { medium.along(direction, distance) } -> std::same_as<MediumSegment>;
};

template <MediumMember... Members>
using MediumList = std::variant<Members...>;

using Medium = MediumList<Haze, DaylightAir>;

}  // namespace strata::shaders
