#include "tools/job/settings_mark.h"

#include <fmt/format.h>

#include <cstdint>

#include "src/scene/printer.h"

namespace strata::tools::job {

std::string settings_mark(const scene::Scene& scene, const film::Rect& window, const std::string& tracer) {
    scene::Scene costly = scene;
    costly.title.clear();
    costly.film = costly.film.without_colour();
    const std::string text = fmt::format("{}\n{},{},{},{}\n{}", scene::print_scene(costly), window.x0, window.y0,
                                         window.x1, window.y1, tracer);
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return fmt::format("{:016x}", hash);
}

}  // namespace strata::tools::job
