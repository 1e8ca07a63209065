// Every medium: what fills the way from the eye to what it sees. A new one is a file like its neighbours here, its
// #include and its name in the list. A scene has all that are in it, none as a rule or one; of several, each takes what
// the one before it in the list has left.
#pragma once

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/media/clouds.h"
#include "shaders_cpu/media/daylight_air.h"
#include "shaders_cpu/media/fog.h"
#include "shaders_cpu/media/haze.h"
#include "shaders_cpu/medium_ray.h"
#include "shaders_cpu/medium_segment.h"

namespace strata::shaders {

// along: what is between the eye and the end of a ray.
// kBeforeBackground: whether rays that meet nothing go through it, too. A background holds what is in front of it as a
// rule: the sky is seen through all of the air.
template <class T>
concept MediumMember = ListMember<T> && requires(const T medium, const MediumRay& ray) {
    { T::kBeforeBackground } -> std::convertible_to<bool>;
    { medium.along(ray) } -> std::same_as<MediumSegment>;
};

template <MediumMember... Members>
using MediumList = std::variant<Members...>;

using Medium = MediumList<Haze, DaylightAir, CloudsBehind, Fog, CloudsBefore>;

}  // namespace strata::shaders
