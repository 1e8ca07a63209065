#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "src/scene/enum_names.h"
#include "src/scene/key_text.h"
#include "tools/cli/command_line.h"
#include "tools/cli/duration.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/scene_argument.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/converge/report.h"
#include "tools/report/folder.h"

namespace strata::tools::converge {

namespace {

namespace fs = std::filesystem;
using scene::EstimatorKind;

constexpr int kMostSeeds = 10000;
constexpr int kDefaultSide = 64;  // px, of the longer side of a frame

std::string all_that_take_several_samples() {
    std::vector<std::string_view> names;
    for (const scene::EstimatorRow& row : scene::all_estimators()) {
        if (!row.is_single) names.push_back(row.name);
    }
    return fmt::format("{}", fmt::join(names, ","));
}

// A line each.
std::string table_of_estimators() {
    std::vector<std::string> lines;
    for (const scene::EstimatorRow& row : scene::all_estimators()) {
        lines.push_back(fmt::format("{}: {}", row.name, row.meaning));
    }
    return fmt::format("{}", fmt::join(lines, "\n"));
}

struct Request {
    cli::SceneArgument scene;
    std::string estimators = all_that_take_several_samples();
    std::string orders = "1,4", Ns = "1,2,4,8,16,32", tracers = "fast";
    std::optional<int> seeds, threads;
    int repeats = 3;
    double budget_s = 0;
    std::string folder;
    bool quiet = false;
};

std::vector<std::string> words(const char* option, const std::string& text) {
    std::vector<std::string> list = cli::split_at_commas(text);
    if (std::ranges::find(list, "") == list.end()) return list;
    throw cli::UsageError(
        fmt::format("{} {}: allowed: a list with commas between, none of them empty", option, scene::excerpt(text)));
}

template <class Value>
void add_once(std::vector<Value>& list, Value value) {
    if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

std::vector<EstimatorKind> parse_estimators(const std::string& text) {
    const std::vector<std::string> known(scene::kEnumNames<EstimatorKind>.begin(),
                                         scene::kEnumNames<EstimatorKind>.end());
    std::vector<EstimatorKind> kinds;
    words("--estimators", text);
    for (const std::size_t i : cli::parse_names("--estimators", "estimator", text, known)) {
        add_once(kinds, *scene::from_name<EstimatorKind>(known[i]));
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
void choose_size(const Request& request, scene::Film& film) {
    if (request.scene.size_given()) return;
    const double scale = 1.0 * kDefaultSide / std::max(film.width, film.height);
    if (scale >= 1) return;
    film.width = std::max(1, static_cast<int>(std::lround(scale * film.width)));
    film.height = std::max(1, static_cast<int>(std::lround(scale * film.height)));
}

Settings parse_settings(const Request& request, const scene::Scene& scene) {
    Settings settings;
    settings.estimators = parse_estimators(request.estimators);
    settings.orders = parse_integers("--m", request.orders, 1, 100);
    settings.Ns = parse_integers("--N", request.Ns, 1, 64);
    settings.tracers = parse_tracers(request.tracers, scene);
    settings.seeds = request.seeds.value_or(0);
    settings.repeats = request.repeats;
    settings.threads = request.threads.value_or(0);
    settings.budget_s = request.budget_s;
    return settings;
}

int converge_command(const Request& request) {
    const parallel::CancelToken& cancel = cli::cancel_by_signals();
    cli::LoadedScene loaded = request.scene.load();
    choose_size(request, loaded.scene.film);
    const Settings settings = parse_settings(request, loaded.scene);
    cli::PlannedFiles files;
    const std::string wanted = request.folder.empty() ? loaded.name + "-converge" : request.folder;
    const fs::path folder = report::prepare_folder(wanted, report_files, files);
    cli::ProgressPrinter progress(request.quiet);
    const Experiment experiment = run_experiment(loaded.scene, settings, progress, cancel);
    progress.clear();
    if (experiment.points.empty()) {
        if (!request.quiet) cli::print_error("stopped before the first point was measured");
    } else {
        const Analysis analysis = analyse(experiment);
        const Report report{loaded.name, experiment, analysis};
        write_report(report, folder, files);
        if (!request.quiet) {
            cli::print_out(converge_summary(report));
            if (files.all_written())
                cli::print_out(
                    fmt::format("\nwrote    {} in {}\n", folder.string(), cli::duration_text(experiment.seconds)));
        }
    }
    return cli::exit_code_of(files.all_written());
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command =
        program.add_subcommand("converge", "Measure error against time of estimators, and report it");
    auto request = std::make_shared<Request>();
    request->scene.add_scene_to(
        *command,
        "What to picture: edge, zoneplate, checker, constant or ramp (compared with the exact picture), any other "
        "built-in scene, a scene file or a picture of strata (compared with a reference render). Without --size the "
        "frame is made smaller, 64 pixels at its longer side");
    const auto list = [&](const char* name, std::string& value, const std::string& meaning) {
        command->add_option(name, value, "LIST", meaning)->capture_default_str();
    };
    list("--estimators", request->estimators, "Which, with commas between, of\n" + table_of_estimators());
    list("--m", request->orders, "Orders of the B-spline, 1 to 100; super is order 1 whatever is said");
    list("--N", request->Ns, "Samples a side, 1 to 64");
    list("--tracers", request->tracers, "fast, reference or both");
    command->add_option(
        "--seeds", request->seeds, 1, kMostSeeds, "S",
        "Independent renders of a point that its error is taken from; default 16, of surfaces and the wheel 4");
    command->add_option("--repeats", request->repeats, 1, kMostSeeds, "R",
                        "Timed renders of a point, at least; each seed is one");
    command->add_option("--threads", request->threads, 1, 1024, "n",
                        "Threads of every render, 1 to 1024; default one for what is timed, all for the reference");
    command->add_option(
        "--budget", [request](const std::string& text) { request->budget_s = cli::parse_duration("--budget", text); },
        "5m|90s|1h", "End in this time, by leaving out the largest N and then seeds, as a pilot run predicts");
    command->add_option("-o,--output", request->folder, "DIR",
                        "Folder for the report, made if it is not there; default SCENE-converge");
    cli::add_quiet(*command, request->quiet, "No progress and no summary");
    command->footer(
        "Writes summary.md (what to pick, in words), converge.csv, converge.json, error-samples and error-time as PNG "
        "and SVG.\n"
        "Seeds are sampling.seed and those after it. Rendering is deterministic; only times differ from run to run.\n"
        "Errors: linear radiance, all pixels and channels, against the picture of the same filter. rmse_ci is half the "
        "95 % interval, over the seeds.\n"
        "limited_by: 'reference', the error is within three times the reference's own; 'rounding', within that of "
        "floats.\n"
        "On SIGINT, SIGTERM or SIGHUP the report is of the seeds that are finished.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.");
    command->action([request] { return converge_command(*request); });
}

}  // namespace strata::tools::converge
