// Closed lists of materials, lights, media and backgrounds: a std::variant of small classes, each in a file of its own.
// A class says itself in which scenes it takes part, so that a list is read here and nowhere else.
#pragma once

#include <concepts>
#include <stdexcept>
#include <type_traits>
#include <variant>
#include <vector>

#include "shaders_cpu/daylight_scene.h"
#include "src/scene/scene.h"

namespace strata::shaders {

// What members of the lists are made from. References live as long as the members.
struct ShaderInputs {
    const scene::Scene& scene;      // valid
    const DaylightScene* daylight;  // its tables; null unless scene.sky.model is daylight
};

// Part of every member's concept.
template <class T>
concept ListMember = requires(const scene::Scene& scene) {
    { T::is_in(scene) } -> std::same_as<bool>;
}
&&std::constructible_from<T, const ShaderInputs&>;

// Those that a scene has, in the list's order.
template <class... Members>
std::vector<std::variant<Members...>> members_in(const ShaderInputs& inputs,
                                                 std::type_identity<std::variant<Members...>> /*list*/) {
    std::vector<std::variant<Members...>> found;
    found.reserve(sizeof...(Members));
    const auto look_at = [&]<class Member>(std::type_identity<Member>) {
        if (Member::is_in(inputs.scene)) found.push_back(Member(inputs));
    };
    (look_at(std::type_identity<Members>{}), ...);
    return found;
}

template <class List>
std::vector<List> members_in(const ShaderInputs& inputs) {
    return members_in(inputs, std::type_identity<List>{});
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
