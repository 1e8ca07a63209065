#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "src/image/image_error.h"
#include "src/parallel/cancel.h"
#include "src/scene/enum_names.h"
#include "src/scene/key_text.h"
#include "src/scene/suggest.h"
#include "tools/cli/command_line.h"
#include "tools/cli/duration.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/scene_argument.h"
#include "tools/cli/standard_output.h"
#include "tools/converge/report.h"

namespace strata::tools::converge {

namespace {

namespace fs = std::filesystem;
using scene::EstimatorKind;

constexpr int kDefaultSide = 64;  // px, of the longer side of a frame

struct ConvergeRequest {
    cli::SceneArgument scene;
    std::string estimators = "super,uniform,jittered,stratified,random,sobol,shared,shared-sobol";
    std::string orders = "1,4", Ns = "1,2,4,8,16,32", tracers = "fast";
    std::string seeds, repeats = "3", threads, budget, folder;
    bool quiet = false;
};

std::vector<std::string> words(const char* option, const std::string& text) {
    std::vector<std::string> list;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        list.push_back(text.substr(start, end - start));
        if (list.back().empty()) {
            throw cli::UsageError(fmt::format("{} {}: allowed: a list with commas between, none of them empty", option,
                                              scene::excerpt(text)));
        }
        start = end + 1;
    }
    return list;
}

template <class Value>
void add_once(std::vector<Value>& list, Value value) {
    if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

std::vector<EstimatorKind> parse_estimators(const std::string& text) {
    const std::vector<std::string> known(scene::kEnumNames<EstimatorKind>.begin(),
                                         scene::kEnumNames<EstimatorKind>.end());
    std::vector<EstimatorKind> kinds;
    for (const std::string& word : words("--estimators", text)) {
        const auto kind = scene::from_name<EstimatorKind>(word);
        if (!kind) {
            const auto near = scene::nearest(word, known);
            throw cli::UsageError(fmt::format("--estimators: {}: allowed: {}{}", scene::excerpt(word),
                                              fmt::join(known, ", "),
                                              near ? fmt::format("; did you mean '{}'?", *near) : ""));
        }
        add_once(kinds, *kind);
    }
    return kinds;
}

std::vector<int> parse_integers(const char* option, const std::string& text, int least, int most) {
    std::vector<int> values;
    for (const std::string& word : words(option, text)) add_once(values, cli::parse_integer(option, word, least, most));
    std::ranges::sort(values);
    return values;
}

std::vector<integrate::Tracer> parse_tracers(const std::string& text, const scene::Scene& scene) {
    std::vector<integrate::Tracer> tracers;
    for (const std::string& word : words("--tracers", text)) {
        if (word != "fast" && word != "reference")
            throw cli::UsageError(fmt::format("--tracers: {}: allowed: fast, reference", scene::excerpt(word)));
        add_once(tracers, cli::parse_tracer(word));
    }
    if (scene.image != scene::ImageKind::surface && tracers != std::vector{integrate::Tracer::fast}) {
        throw cli::UsageError(fmt::format("--tracers {}: image '{}' has no surface to trace; allowed: fast",
                                          scene::excerpt(text), scene::name_of(scene.image)));
    }
    return tracers;
}

// Errors per pixel do not need many pixels; time does.
void choose_size(const ConvergeRequest& request, scene::Film& film) {
    if (request.scene.size_given()) return;
    const double scale = 1.0 * kDefaultSide / std::max(film.width, film.height);
    if (scale >= 1) return;
    film.width = std::max(1, static_cast<int>(std::lround(scale * film.width)));
    film.height = std::max(1, static_cast<int>(std::lround(scale * film.height)));
}

ConvergeSettings parse_settings(const ConvergeRequest& request, const scene::Scene& scene) {
    constexpr int kMostSeeds = 10000;
    ConvergeSettings settings;
    settings.estimators = parse_estimators(request.estimators);
    settings.orders = parse_integers("--m", request.orders, 1, 100);
    settings.Ns = parse_integers("--N", request.Ns, 1, 64);
    settings.tracers = parse_tracers(request.tracers, scene);
    if (!request.seeds.empty()) settings.seeds = cli::parse_integer("--seeds", request.seeds, 1, kMostSeeds);
    settings.repeats = cli::parse_integer("--repeats", request.repeats, 1, kMostSeeds);
    if (!request.threads.empty()) settings.threads = cli::parse_integer("--threads", request.threads, 1, 1024);
    if (!request.budget.empty()) settings.budget_s = cli::parse_duration("--budget", request.budget);
    return settings;
}

fs::path prepare_folder(const std::string& folder, const std::string& name, cli::PlannedFiles& files) {
    fs::path path = folder.empty() ? fs::path(name + "-converge") : fs::path(folder);
    std::error_code error;
    fs::create_directories(path, error);
    if (!fs::is_directory(path)) {
        throw image::ImageError(fmt::format("-o {}: cannot make this folder: {}", path.string(),
                                            error ? error.message() : "a file is in its place"));
    }
    for (const fs::path& file : report_files(path)) files.plan(file);
    report::check_plotter();
    return path;
}

int converge_command(const ConvergeRequest& request) {
    static parallel::CancelToken cancel;
    parallel::cancel_on_signals(cancel);
    cli::LoadedScene loaded = request.scene.load();
    choose_size(request, loaded.scene.film);
    const ConvergeSettings settings = parse_settings(request, loaded.scene);
    cli::PlannedFiles files;
    const fs::path folder = prepare_folder(request.folder, loaded.name, files);
    cli::ProgressPrinter progress(request.quiet);
    const Experiment experiment = run_experiment(loaded.scene, settings, progress, cancel);
    progress.clear();
    if (experiment.points.empty()) {
        if (!request.quiet) cli::print_error("stopped before the first point was measured");
    } else {
        const Analysis analysis = analyse(experiment);
        const ConvergeReport report{loaded.name, experiment, analysis};
        write_report(report, folder, files);
        if (!request.quiet) {
            cli::print_out(converge_summary(report));
            if (files.all_written())
                cli::print_out(
                    fmt::format("\nwrote    {} in {}\n", folder.string(), cli::duration_text(experiment.seconds)));
        }
    }
    if (!files.all_written()) return cli::kExitRuntime;
    return parallel::cancelling_signal() != 0 ? cli::kExitSignal + parallel::cancelling_signal() : 0;
}

}  // namespace

void add_command(cli::Command& program, int& exit_code) {
    cli::Command* command =
        program.add_subcommand("converge", "Measure error against time of estimators, and report it");
    auto request = std::make_shared<ConvergeRequest>();
    request->scene.add_scene_to(*command,
                                "What to picture: edge, zoneplate, checker, constant or ramp (compared with the exact "
                                "picture), any other built-in "
                                "scene, a scene file or a picture of strata (compared with a reference render). "
                                "Without --size the frame is made "
                                "smaller, 64 pixels at its longer side");
    const auto list = [&](const char* name, std::string& value, const char* meaning) {
        command->add_option(name, value, meaning)->type_name("LIST")->capture_default_str();
    };
    list("--estimators", request->estimators, "Which, with commas between; also none");
    list("--m", request->orders, "Orders of the B-spline, 1 to 100; super is order 1 whatever is said");
    list("--N", request->Ns, "Samples a side, 1 to 64");
    list("--tracers", request->tracers, "fast, reference or both");
    command
        ->add_option(
            "--seeds", request->seeds,
            "Independent renders of a point that its error is taken from; default 16, of surfaces and the wheel 4")
        ->type_name("S");
    command->add_option("--repeats", request->repeats, "Timed renders of a point, at least; each seed is one")
        ->type_name("R")
        ->capture_default_str();
    command
        ->add_option("--threads", request->threads,
                     "Threads of every render, 1 to 1024; default one for what is timed, all for the reference")
        ->type_name("n");
    command
        ->add_option("--budget", request->budget,
                     "End in this time, by leaving out the largest N and then seeds, as a pilot run predicts")
        ->type_name("5m|90s|1h");
    command
        ->add_option("-o,--output", request->folder,
                     "Folder for the report, made if it is not there; default SCENE-converge")
        ->type_name("DIR");
    command->add_flag("--quiet", request->quiet, "No progress and no summary");
    command->footer(
        "Writes summary.md (what to pick, in words), converge.csv, converge.json, error-samples and error-time as PNG "
        "and "
        "SVG.\n"
        "Seeds are sampling.seed and those after it. Rendering is deterministic; only times differ from run to run.\n"
        "Errors: linear radiance, all pixels and channels, against the picture of the same filter. rmse_ci is half the "
        "95 % "
        "interval, over the seeds.\n"
        "limited_by: 'reference', the error is within three times the reference's own; 'rounding', within that of "
        "floats.\n"
        "On SIGINT, SIGTERM or SIGHUP the report is of the seeds that are finished.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.");
    command->callback([request, &exit_code] { exit_code = converge_command(*request); });
}

}  // namespace strata::tools::converge
