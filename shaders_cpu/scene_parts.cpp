#include "shaders_cpu/scene_parts.h"

#include "shaders_cpu/backgrounds/all.h"
#include "shaders_cpu/lights/all.h"
#include "shaders_cpu/materials/all.h"
#include "shaders_cpu/media/all.h"

namespace strata::shaders {

namespace {

template <class Member>
bool has_part(const scene::Scene& scene) {
    if constexpr (requires { Member::has_part(scene); }) {
        return Member::is_in(scene) && Member::has_part(scene);
    } else {
        return Member::is_in(scene);
    }
}

// Of a list all of whose members in a scene count.
template <class List>
void add_all_of(const scene::Scene& scene, std::vector<ScenePart>& parts) {
    for_each_class<List>([&]<class Member>(std::type_identity<Member>) {
        parts.push_back({Member::kName, has_part<Member>(scene), Member::why(scene)});
    });
}

// Of a list the first of whose members in a scene counts.
template <class List>
void add_first_of(const scene::Scene& scene, std::vector<ScenePart>& parts) {
    bool is_found = false;
    for_each_class<List>([&]<class Member>(std::type_identity<Member>) {
        const bool is_first = !is_found && Member::is_in(scene);
        is_found = is_found || is_first;
        parts.push_back({Member::kName, is_first, Member::why(scene)});
    });
}

}  // namespace

std::vector<ScenePart> scene_parts(const scene::Scene& scene) {
    std::vector<ScenePart> parts;
    add_all_of<Light>(scene, parts);
    add_first_of<Background>(scene, parts);
    add_all_of<Medium>(scene, parts);
    add_first_of<Material>(scene, parts);
    return parts;
}

}  // namespace strata::shaders
