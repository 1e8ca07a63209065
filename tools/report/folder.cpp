#include "tools/report/folder.h"

#include <fmt/format.h>

#include <system_error>

#include "src/image/image_error.h"

namespace strata::tools::report {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (fs::is_directory(folder)) return;
    throw image::ImageError(fmt::format("-o {}: cannot make this folder: {}", folder.string(),
                                        error ? error.message() : "a file is in its place"));
}

fs::path prepare_folder(const fs::path& folder, std::vector<fs::path> (*files_in)(const fs::path&),
                        cli::PlannedFiles& files) {
    make_folder(folder);
    for (const fs::path& file : files_in(folder)) files.plan(file);
    check_plotter();
    return folder;
}

void write_plots(const Plot& plot, const fs::path& folder, const std::string& name, cli::PlannedFiles& files) {
    if (plot.panels.empty()) return;
    for (const char* extension : {".png", ".svg"}) {
        const fs::path path = folder / (name + extension);
        files.write_made(path, [&] { return draw_plot(plot, path); });
    }
}

}  // namespace strata::tools::report
