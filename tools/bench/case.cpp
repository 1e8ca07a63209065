#include "tools/bench/case.h"

#include <fmt/format.h>

#include "noise/hash.h"
#include "tools/job/settings_mark.h"

namespace strata::tools::bench {

std::string Case::id() const {
    std::string text = fmt::format("{} {}x{} N={}", scene_name, scene.film.width, scene.film.height, scene.sampling.N);
    if (tracer == integrate::Tracer::reference) text += " reference";
    if (threads != 1) text += fmt::format(" threads={}", threads);
    return text;
}

std::string Case::mark() const {
    std::uint64_t sum = noise::mix64(static_cast<std::uint64_t>(threads));
    for (const film::Rect& window : subset.windows) {
        sum = noise::mix64(sum + std::stoull(job::settings_mark({scene, window, tracer}), nullptr, 16));
    }
    return fmt::format("{:016x}", sum);
}

}  // namespace strata::tools::bench
