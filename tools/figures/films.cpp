#include "tools/figures/films.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/process.h"
#include "tools/figures/record.h"

namespace strata::tools::animate {
void add_command(cli::Command& program, int& exit_code);
}

namespace strata::tools::figures {

namespace {

namespace fs = std::filesystem;

std::string size_text(int width, int height, Size size) {
    return fmt::format("{}x{}", scaled(width, size), scaled(height, size));
}

fs::path record_path(const Film& film, const fs::path& folder) { return folder / (film.name + ".json"); }

}  // namespace

std::vector<Film> films(Size size) {
    return {
        {"animation-1",
         "Animation 1. A rotating iso-surface",
         "A complex rotating iso-surface: on the left without anti-aliasing, on the right anti-aliased in space and "
         "time by "
         "cubic B-splines with 16 samples a pixel. It loops without a seam. The surface is chosen.",
         {"isosurface", "--size", size_text(400, 300, size)}},
        {"animation-2",
         "Animation 2. The wagon wheel",
         "The wheel in motion, 25 frames a second: on the left through the shutter, a box in time, on the right "
         "through the "
         "cubic B-spline. The wheel and its speed are chosen.",
         {"wheel", "--size", size_text(400, 400, size)}},
    };
}

std::vector<std::string> film_files(const Film& film) { return {film.name + ".webm", film.name + ".mp4"}; }

nlohmann::ordered_json film_record(const Film& film) {
    std::string command = fmt::format("strata animate {}", fmt::join(film.settings, " "));
    for (const std::string& file : film_files(film)) command += " -o " + file;
    return {{"animation", film.name}, {"title", film.title},       {"caption", film.caption},
            {"command", command},     {"version", STRATA_VERSION}, {"files", film_files(film)}};
}

bool is_made(const Film& film, const fs::path& folder, bool quiet) {
    return is_made(record_path(film, folder), film_record(film), film_files(film), quiet);
}

bool make_film(const Film& film, const FilmOptions& options) {
    empty_record(record_path(film, options.folder));
    std::vector<std::string> words{"animate"};
    words.insert(words.end(), film.settings.begin(), film.settings.end());
    for (const std::string& file : film_files(film)) {
        words.insert(words.end(), {"-o", (options.folder / file).string()});
    }
    words.insert(words.end(), {"--threads", options.threads});
    if (options.overwrite) words.emplace_back("--overwrite");
    if (options.quiet) words.emplace_back("--quiet");

    cli::Command program;
    int exit_code = 0;
    animate::add_command(program, exit_code);
    program.parse(std::move(words));
    if (exit_code == cli::kExitRuntime) throw cli::ProcessError(film.name + " could not be made");
    if (exit_code != 0) return false;
    write_record(record_path(film, options.folder), film_record(film), film_files(film));
    return true;
}

}  // namespace strata::tools::figures
