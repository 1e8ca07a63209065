#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "src/image/image_error.h"
#include "src/parallel/cancel.h"
#include "tools/bench/peers.h"
#include "tools/bench/report.h"
#include "tools/bench/run.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/scene_argument.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::bench {

namespace {

namespace fs = std::filesystem;

constexpr int kMostRays = 1'000'000'000;

struct BenchRequest {
    std::string only, folder = "strata-bench", against, repeat, rays, simd;
    bool quick = false, whole = false, peers = false, no_files = false, quiet = false;
};

std::vector<Section> chosen_sections(const BenchRequest& request) {
    std::vector<Section> sections;
    if (!request.only.empty()) {
        sections = parse_sections(request.only);
    } else {
        for (const SectionName& name : section_names()) {
            if (name.by_default) sections.push_back(name.section);
        }
    }
    if (request.peers && std::ranges::find(sections, Section::peers) == sections.end()) {
        sections.push_back(Section::peers);
    }
    return sections;
}

PlanSettings parse_settings(const BenchRequest& request) {
    PlanSettings settings{chosen_sections(request), request.quick, request.whole, {}};
    if (!request.rays.empty()) settings.rays = cli::parse_integer("--rays", request.rays, 1, kMostRays);
    if (settings.rays && settings.whole) {
        throw cli::UsageError(
            "--whole and --rays: allowed: one of them; --whole measures whole frames, whatever their rays");
    }
    return settings;
}

fs::path prepare_folder(const BenchRequest& request, cli::PlannedFiles& files) {
    fs::path path(request.folder);
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

int bench_command(const BenchRequest& request) {
    static parallel::CancelToken cancel;
    parallel::cancel_on_signals(cancel);
    if (!request.simd.empty()) cli::use_simd_target(request.simd);
    const int rounds =
        request.repeat.empty() ? (request.quick ? 1 : 3) : cli::parse_integer("--repeat", request.repeat, 1, 1000);
    const Plan plan = make_plan(parse_settings(request));
    std::optional<EarlierRun> earlier;
    if (!request.against.empty()) {
        earlier = read_earlier(request.against);
        check_comparable(*earlier, plan);
    }
    fs::path folder;
    cli::PlannedFiles files;
    if (!request.no_files) folder = prepare_folder(request, files);
    if (plan.has(Section::peers)) install_peers();

    cli::ProgressPrinter progress(request.quiet);
    const Results results = run(plan, rounds, progress.callback(), cancel);
    progress.clear();
    const bool interrupted = cancel.requested();
    const std::vector<Figure> figures = figures_of(results);
    std::vector<Comparison> comparisons;
    if (earlier) comparisons = compare(*earlier, results.measurements);
    if (!request.quiet && (!interrupted || results.rounds > 0)) {
        cli::print_out(text_report(results, figures, comparisons));
    }
    if (interrupted) {
        cli::print_error(fmt::format("interrupted after {} of {} rounds; no file was written", results.rounds, rounds));
        return cli::kExitSignal + parallel::cancelling_signal();
    }
    if (request.no_files) return 0;
    write_report(folder, results, figures, comparisons, files);
    if (!files.all_written()) return cli::kExitRuntime;
    if (!request.quiet) cli::print_out(fmt::format("\nwrote    {}\n", folder.string()));
    return 0;
}

std::string sections_text() {
    std::string text;
    for (const SectionName& name : section_names()) {
        text += fmt::format("  {:<11} {}{}\n", name.name, name.meaning, name.by_default ? "" : " (only when named)");
    }
    return text;
}

}  // namespace

void add_command(cli::Command& program, int& exit_code) {
    cli::Command* command = program.add_subcommand("bench", "Measure the engine on fixed scenes, against its targets");
    auto request = std::make_shared<BenchRequest>();
    command->add_option("--only", request->only, "Only these sections, with commas between; see below")
        ->type_name("SECTION,...");
    command->add_flag(
        "--quick", request->quick,
        "Small frames, few rays, one round: seconds, to see that all works; its counts are exact too, its "
        "times rough");
    command
        ->add_option("--repeat", request->repeat,
                     "Rounds, each of every case once; the least and the median time count; default 3, with --quick 1")
        ->type_name("R");
    command->add_option("--against", request->against, "Print the ratio of this run to an earlier one's bench.json")
        ->type_name("FILE.json");
    command->add_flag("--peers", request->peers,
                      "POV-Ray and Embree too, as far as they are installed; the same as section peers");
    command->add_flag(
        "--whole", request->whole,
        "Whole frames: 1920x1080 at N = 10 is 207 M rays a case and round. Without it frames of more than "
        "1 M rays are measured in 16 fixed blocks, chosen to be like all of them");
    command->add_option("--rays", request->rays, "Rays that a case's blocks have at most, nearly; one block at least")
        ->type_name("R");
    command->add_option("--simd", request->simd, "avx512, avx2, sse4 or scalar; default the best that is here")
        ->type_name("TARGET");
    command->add_option("-o,--output", request->folder, "Folder for the report, made if it is not there")
        ->capture_default_str()
        ->type_name("DIR");
    command->add_flag("--no-files", request->no_files, "The table alone");
    command->add_flag("--quiet", request->quiet, "No progress and no table");
    command->footer(
        "Sections:\n" + sections_text() +
        "Writes bench.json, bench.txt (the table), bench.png and bench.svg. Times are CPU times of one thread, of all "
        "that a\nrender does but starting and writing; those of 'threads' are by the clock. 'evals/ray' counts shadow "
        "rays'\nand normals' evaluations too, over the camera's rays. Counts are the same in every run on a SIMD "
        "target; "
        "cases are\nmeasured in turns. Verdicts: 'PASS, aim', 'PASS' (the floor), 'SHORT'. They do not change the exit "
        "code.\n"
        "On SIGINT, SIGTERM or SIGHUP the table is of the rounds that are finished, and no file is written.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or a file that --against cannot compare, 129, "
        "130 or "
        "143\ninterrupted.");
    command->callback([request, &exit_code] { exit_code = bench_command(*request); });
}

}  // namespace strata::tools::bench
