#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <system_error>

#include "src/image/output_file.h"
#include "src/image/text.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/process.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/figures/figure_maker.h"
#include "tools/figures/films.h"
#include "tools/figures/page.h"
#include "tools/report/plot.h"

namespace strata::tools::figures {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPage = "index.html";

struct FiguresRequest {
    std::string only, size = "paper", folder = "figures";
    int threads = 0;
    bool quiet = false, overwrite = false, html = false, no_films = false;
};

std::vector<Figure> chosen_figures(const std::string& only) {
    const auto all = all_figures();
    if (only.empty()) return {all.begin(), all.end()};
    std::set<int> numbers;
    for (const std::string& word : cli::split_at_commas(only)) {
        numbers.insert(cli::parse_integer("--only", word, all.front().number, all.back().number));
    }
    std::vector<Figure> chosen;
    for (const Figure& figure : all) {
        if (numbers.contains(figure.number)) chosen.push_back(figure);
    }
    return chosen;
}

Size parse_size(const std::string& name) {
    const auto found = std::ranges::find(kSizeNames, name);
    if (found == std::end(kSizeNames)) {
        throw cli::UsageError(fmt::format("--size {}: allowed: small, paper, large", name));
    }
    return static_cast<Size>(found - std::begin(kSizeNames));
}

// The folder, made if need be; everything else that the figures need is there.
void check_surroundings(const std::vector<Figure>& chosen, const MakeOptions& options) {
    const fs::path& folder = options.folder;
    image::check_fonts();
    if (std::ranges::any_of(chosen, &Figure::is_plot)) report::check_plotter();
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw cli::UsageError(fmt::format("-o {}: {}", folder.string(), error.message()));
    for (const Figure& figure : chosen) {
        for (const fs::path& path : paths_of(figure, options)) image::check_replaceable(path);
    }
    image::check_replaceable(folder / kPage);
}

bool makes_films(const FiguresRequest& request) { return request.html && !request.no_films; }

void say(const char* what, const fs::path& path, bool quiet) {
    if (!quiet) cli::print_out(fmt::format("{}     {}\n", what, path.string()));
}

// Each fails alone. False if one did.
bool make_films(const MakeOptions& options, const parallel::CancelToken& cancel) {
    bool all = true;
    for (const Film& film : films(options.size)) {
        const bool kept = !options.overwrite && is_made(film, options);
        const auto make = [&] {
            if (!make_film(film, options, cancel)) throw Interrupted();
        };
        if (!kept) all &= cli::is_written(options.folder / film.name, make);
        if (kept) say("kept", options.folder / film_files(film).front(), options.quiet);
    }
    return all;
}

void make_page(const MakeOptions& options) {
    write_page(options.folder);
    say("made", options.folder / kPage, options.quiet);
}

int figures_command(const FiguresRequest& request) {
    const std::vector<Figure> chosen = chosen_figures(request.only);
    const MakeOptions options{.folder = request.folder,
                              .size = parse_size(request.size),
                              .threads = request.threads,
                              .quiet = request.quiet,
                              .overwrite = request.overwrite};
    check_surroundings(chosen, options);
    if (makes_films(request)) cli::find_program("ffmpeg", "ffmpeg", "video");
    const parallel::CancelToken& cancel = cli::cancel_by_signals();
    bool all = true;
    try {
        all = make_figures(chosen, options, cancel);
        if (makes_films(request)) all &= make_films(options, cancel);
        if (request.html) make_page(options);
    } catch (const Interrupted&) {
        if (!options.quiet) cli::print_out("stopped  finished figures are kept: the same command makes the rest\n");
    }
    // A signal is why figures are missing, whatever else failed.
    return cli::exit_code_of(all || cancel.requested());
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command = program.add_subcommand("figures", "Make the figures of Gamito & Maddock 2006 anew");
    auto request = std::make_shared<FiguresRequest>();
    command->add_option("--only", request->only, "K,K...", "Figures to make, 1 to 8, separated by commas; default all");
    command->add_option("-o,--output", request->folder, "DIR", "Folder to write to, made if it is not there")
        ->capture_default_str();
    command
        ->add_option(
            "--size", request->size, "NAME",
            "small, paper or large: lengths in pixels at half, once and twice the paper's; the numbers of samples stay")
        ->capture_default_str();
    cli::add_threads(*command, request->threads);
    command->add_flag("--overwrite", request->overwrite, "Make figures anew that are there already");
    command->add_flag("--html", request->html,
                      "Make the two animations (webm and mp4) and DIR/index.html too: every figure and film of the "
                      "folder, with captions and sliders between pictures");
    command->add_flag("--no-films", request->no_films, "With --html: leave the animations as they are");
    cli::add_quiet(*command, request->quiet, "No progress and no list of what was made");
    command->footer(
        "1  B-splines and their spectra          5  the whole surface\n"
        "2  iterations of the inverse            6  an area of it: none; cubic with N = 2, 3, 10\n"
        "3  sampling patterns                    7  another: none; m = 1, 4, 15 at N = 10\n"
        "4  zone plate and receding checker      8  the wagon wheel: box and cubic in time\n"
        "Each is figure-K.png (plots: figure-K.svg too), the panels and float EXR parts it was assembled from, and\n"
        "figure-K.json: one line with every parameter and with what was chosen where the paper does not tell.\n"
        "A figure that is there, whole, with the same parameters and by the same version, is kept; one with\n"
        "an empty, cut or damaged file is made again; plots are drawn anew.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line, 129, 130 or 143 interrupted.");
    command->action([request] { return figures_command(*request); });
}

}  // namespace strata::tools::figures
