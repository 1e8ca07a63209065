// Every background: what a ray sees that meets nothing. A new one is a file like its neighbours here, its #include and
// its name in the list; a scene has the first that is in it.
#pragma once

#include "shaders_cpu/backgrounds/daylight_sky.h"
#include "shaders_cpu/backgrounds/gradient_sky.h"
#include "shaders_cpu/closed_list.h"

namespace strata::shaders {

// radiance: linear, from a unit direction by the axes in which the sky lies.
// gain: how much more of it lights the ground; 1 is true.
// Beside these it may have sample(u, v), a direction by the density pdf(direction) per steradian, for sky rays: a
// member without is taken to be about as bright everywhere.
template <class T>
concept BackgroundMember = ListMember<T> && requires(const T background, const glm::dvec3& direction) {
    { background.radiance(direction) } -> std::same_as<glm::vec3>;
    { background.gain() } -> std::same_as<double>;
};

template <BackgroundMember... Members>
using BackgroundList = std::variant<Members...>;

using Background = BackgroundList<DaylightSky, GradientSky>;

}  // namespace strata::shaders
