// Every light. A new one is a file like its neighbours here, its #include and its name in the list; a scene has all
// that are in it, and adds them up in the list's order.
#pragma once

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/light_layer.h"
#include "shaders_cpu/lights/chosen_sun.h"
#include "shaders_cpu/lights/daylight_ambient.h"
#include "shaders_cpu/lights/daylight_sun.h"
#include "shaders_cpu/lights/gradient_ambient.h"
#include "shaders_cpu/shading_point.h"

namespace strata::shaders {

// direction: towards the light, or to where most of it comes from; in the world, of unit length.
// angular_radius: of its disc, radians, less than pi / 2; 0: a point. Of a disc each sample is lit from one point,
// evenly by solid angle; on_white then is what makes the mean right. casts_shadows: whether a ray in that direction
// decides if the light arrives. Light of the whole sky has none. on_white: linear radiance of a white Lambert surface
// in this light alone, with nothing in its way.
// kLayer: where it shows when a picture is asked for its light in layers. What is of the sun comes from one direction,
// so that rough surfaces spread it (rough_lobe.h).
template <class T>
concept LightMember = ListMember<T> && requires(const T light, const ShadingPoint& point) {
    { T::kLayer } -> std::convertible_to<LightLayer>;
    { light.direction() } -> std::convertible_to<glm::dvec3>;
    { light.angular_radius() } -> std::same_as<double>;
    { light.casts_shadows() } -> std::same_as<bool>;
    { light.on_white(point) } -> std::same_as<glm::vec3>;
};

// Whether any of the light comes to a place at all, whatever the surface hides; a member that knows where none does has
// a function comes_to(x), and no shadow ray is cast there.
template <LightMember T>
bool comes_to(const T& light, const glm::dvec3& x) {
    if constexpr (requires { light.comes_to(x); }) return light.comes_to(x);
    return true;
}

template <LightMember... Members>
using LightList = std::variant<Members...>;

using Light = LightList<ChosenSun, GradientAmbient, DaylightSun, DaylightAmbient>;

}  // namespace strata::shaders
