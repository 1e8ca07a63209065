#include "tools/job/settings_mark.h"

#include <fmt/format.h>

#include <cstdint>

#include "src/scene/printer.h"
#include "tools/cli/shared_options.h"

namespace strata::tools::job {

std::string settings_mark(const PictureJob& job) {
    scene::Scene costly = job.scene;
    const film::Rect& window = job.window;
    costly.title.clear();
    costly.film = costly.film.without_colour();
    return mark_of(fmt::format("{}\n{},{},{},{}\n{}", scene::print_scene(costly), window.x0, window.y0, window.x1,
                               window.y1, cli::name_of(job.tracer)));
}

std::string mark_of(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325ull;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return fmt::format("{:016x}", hash);
}

}  // namespace strata::tools::job
