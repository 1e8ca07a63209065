// Closed lists of materials, lights, media and backgrounds: a std::variant of small classes, each in a file of its own.
// A class says itself in which scenes it takes part, so that a list is read here and nowhere else.
#pragma once

#include <concepts>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "shaders_cpu/cloud_scene.h"
#include "shaders_cpu/daylight_scene.h"
#include "src/scene/scene.h"

namespace strata::shaders {

// What members of the lists are made from. References live as long as the members.
struct ShaderInputs {
    const scene::Scene& scene;           // valid
    const DaylightScene* daylight;       // its tables; null unless scene.sky.model is daylight
    const CloudScene* clouds = nullptr;  // null unless scene::needs_clouds(scene)
};

// Part of every member's concept. One that is in a scene and may yet add nothing to its picture says so in a
// has_part(scene) of its own.
template <class T>
concept ListMember = requires(const scene::Scene& scene) {
    { T::is_in(scene) } -> std::same_as<bool>;
    { T::kName } -> std::convertible_to<std::string>;       // what it is called when a render is explained
    { T::why(scene) } -> std::convertible_to<std::string>;  // what it does in this scene, or why nothing
}
&&std::constructible_from<T, const ShaderInputs&>;

// Calls look_at(std::type_identity<Member>{}) for all that there are, in the list's order.
template <class LookAt, class... Members>
void for_each_class(const LookAt& look_at, std::type_identity<std::variant<Members...>> /*list*/) {
    (look_at(std::type_identity<Members>{}), ...);
}
template <class List, class LookAt>
void for_each_class(const LookAt& look_at) {
    for_each_class(look_at, std::type_identity<List>{});
}

// Those that a scene has, in the list's order.
template <class List>
std::vector<List> members_in(const ShaderInputs& inputs) {
    std::vector<List> found;
    found.reserve(std::variant_size_v<List>);
    for_each_class<List>([&]<class Member>(std::type_identity<Member>) {
        if (Member::is_in(inputs.scene)) found.push_back(Member(inputs));
    });
    return found;
}

// The first of those that a scene has. Throws std::logic_error where there is none: a list whose scenes need a member
// ends with one that is in all.
template <class List>
List member_in(const ShaderInputs& inputs) {
    const std::vector<List> found = members_in<List>(inputs);
    if (found.empty()) throw std::logic_error("no member of a list of shaders is in this scene");
    return found.front();
}

}  // namespace strata::shaders
