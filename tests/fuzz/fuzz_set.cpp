// Lines of assignments, as --set takes them, to a built-in scene that the first byte chooses: each is refused with a
// SceneError and changes nothing, or the scene prints as it reads.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src/scene/builtin.h"
#include "src/scene/override.h"
#include "tests/fuzz/scene_check.h"

namespace {

using strata::scene::Scene;

const std::vector<Scene>& builtin() {
    static const std::vector<Scene> scenes = [] {
        std::vector<Scene> all;
        for (const auto& scene : strata::scene::builtin_scenes()) {
            all.push_back(strata::scene::read_scene(scene.text, scene.name));
        }
        return all;
    }();
    return scenes;
}

std::string printed(const Scene& scene) { return strata::scene::print_scene(scene, strata::scene::PrintedKeys::all); }

void assign(Scene& scene, std::string_view line) {
    const std::string before = strata::fuzz::is_printed(line.size()) ? printed(scene) : "";
    try {
        strata::scene::apply_override(scene, line);
    } catch (const strata::scene::SceneError&) {
        if (!before.empty() && printed(scene) != before) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    Scene scene = builtin()[data[0] % builtin().size()];
    std::string_view left(reinterpret_cast<const char*>(data) + 1, size - 1);
    for (int lines = 0; !left.empty() && lines < 2; ++lines) {
        const std::size_t end = left.find('\n');
        assign(scene, left.substr(0, end));
        left = end == std::string_view::npos ? std::string_view() : left.substr(end + 1);
    }
    try {
        strata::fuzz::check_scene(scene, size);
    } catch (const strata::scene::SceneError&) {
    }
    return 0;
}
