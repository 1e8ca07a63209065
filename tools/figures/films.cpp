#include "tools/figures/films.h"

#include <fmt/format.h>

#include "tools/animate/make.h"
#include "tools/cli/errors.h"
#include "tools/cli/process.h"
#include "tools/figures/record.h"

namespace strata::tools::figures {

namespace {

namespace fs = std::filesystem;

fs::path record_path(const Film& film, const fs::path& folder) { return folder / (film.name + ".json"); }

}  // namespace

std::vector<Film> films(Size size) {
    return {
        {"animation-1", "Animation 1. A rotating iso-surface",
         "A complex rotating iso-surface: on the left without anti-aliasing, on the right anti-aliased in space and "
         "time by cubic B-splines with 16 samples a pixel. It loops without a seam. The surface is chosen.",
         "isosurface", scaled(400, size), scaled(300, size)},
        {"animation-2", "Animation 2. The wagon wheel",
         "The wheel in motion, 25 frames a second: on the left through the shutter, a box in time, on the right "
         "through the cubic B-spline. The wheel and its speed are chosen.",
         "wheel", scaled(400, size), scaled(400, size)},
    };
}

std::vector<std::string> film_files(const Film& film) { return {film.name + ".webm", film.name + ".mp4"}; }

nlohmann::ordered_json film_record(const Film& film) {
    std::string command = fmt::format("strata animate {} --size {}x{}", film.scene, film.width, film.height);
    for (const std::string& file : film_files(film)) command += " -o " + file;
    return {{"animation", film.name}, {"title", film.title},       {"caption", film.caption},
            {"command", command},     {"version", STRATA_VERSION}, {"files", film_files(film)}};
}

bool is_made(const Film& film, const MakeOptions& options) {
    return is_made(record_path(film, options.folder), film_record(film), film_files(film), options.quiet);
}

bool make_film(const Film& film, const MakeOptions& options, const parallel::CancelToken& cancel) {
    empty_record(record_path(film, options.folder));
    cli::LoadedScene loaded;
    loaded.scene = builtin(film.scene);
    loaded.scene.film.width = film.width;
    loaded.scene.film.height = film.height;
    loaded.name = loaded.source = film.scene;
    animate::Request request;
    for (const std::string& file : film_files(film)) request.outputs.push_back((options.folder / file).string());
    request.threads = options.threads;
    request.overwrite = options.overwrite;
    request.quiet = options.quiet;
    const int exit_code = animate::make_animation(animate::prepare_animation(loaded, request), cancel);
    if (exit_code == cli::kExitRuntime) throw cli::ProcessError(film.name + " could not be made");
    if (exit_code != 0) return false;
    write_record(record_path(film, options.folder), film_record(film), film_files(film));
    return true;
}

}  // namespace strata::tools::figures
