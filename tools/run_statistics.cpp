#include "tools/run_statistics.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "noise/simd_target.h"
#include "src/image/output_file.h"
#include "src/render/progress_printer.h"

namespace strata::tools {

namespace {

std::uint64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// 12345678 -> "12.3 M".
std::string scaled(double count) {
    if (count >= 1e9) return fmt::format("{:.2f} G", count / 1e9);
    if (count >= 1e6) return fmt::format("{:.2f} M", count / 1e6);
    if (count >= 1e4) return fmt::format("{:.1f} k", count / 1e3);
    return fmt::format("{:.0f}", count);
}

}  // namespace

RunStatistics collect(const render::RenderResult& result, const std::string& scene) {
    return {.counters = result.counters,
            .seconds = result.seconds,
            .cpu_seconds = result.cpu_seconds,
            .threads = result.threads,
            .simd_target = noise::simd_target(),
            .peak_memory_bytes = peak_memory(),
            .scene = scene};
}

std::string summary(const RunStatistics& statistics) {
    const render::Counters& c = statistics.counters;
    const double rays = static_cast<double>(c.rays), shadow_rays = static_cast<double>(c.shadow_rays);
    std::string text = fmt::format("time     {} ({:.2f} s on {} thread{}, {:.2f} s of CPU, {})\n",
                                   render::duration_text(statistics.seconds), statistics.seconds, statistics.threads,
                                   statistics.threads == 1 ? "" : "s", statistics.cpu_seconds, statistics.simd_target);
    text += fmt::format("rays     {} and {} shadow rays, {}rays/s\n", scaled(rays), scaled(shadow_rays),
                        scaled((rays + shadow_rays) / std::max(statistics.seconds, 1e-9)));
    if (c.noise_evaluations > 0) {
        text += fmt::format("noise    {:.1f} evaluations a ray, shadow rays and normals included in the count\n",
                            static_cast<double>(c.noise_evaluations) / std::max(1.0, rays + shadow_rays));
    }
    text += fmt::format("memory   {:.0f} MB at most\n", static_cast<double>(statistics.peak_memory_bytes) / 1e6);
    return text;
}

void write_statistics(const std::filesystem::path& path, const RunStatistics& statistics) {
    const render::Counters& c = statistics.counters;
    const nlohmann::ordered_json json = {{"scene", statistics.scene},
                                         {"version", STRATA_VERSION},
                                         {"simd_target", statistics.simd_target},
                                         {"threads", statistics.threads},
                                         {"rays", c.rays},
                                         {"shadow_rays", c.shadow_rays},
                                         {"hits", c.hits},
                                         {"unresolved_rays", c.unresolved_rays},
                                         {"noise_evaluations", c.noise_evaluations},
                                         {"executed_lanes", c.executed_lanes},
                                         {"steps", c.steps},
                                         {"seconds", statistics.seconds},
                                         {"cpu_seconds", statistics.cpu_seconds},
                                         {"peak_memory_bytes", statistics.peak_memory_bytes}};
    // A scene's file name need not be UTF-8.
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    image::replace_file(path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

}  // namespace strata::tools
