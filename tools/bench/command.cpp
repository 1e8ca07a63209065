#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "tools/bench/peers.h"
#include "tools/bench/report.h"
#include "tools/bench/run.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/report/folder.h"

namespace strata::tools::bench {

namespace {

namespace fs = std::filesystem;

constexpr int kMostRays = 1'000'000'000;

struct BenchRequest {
    std::string only, folder = "strata-bench", against;
    std::optional<int> repeat, rays;
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
    if (request.rays) settings.rays = *request.rays;
    if (settings.rays && settings.whole) {
        throw cli::UsageError(
            "--whole and --rays: allowed: one of them; --whole measures whole frames, whatever their rays");
    }
    return settings;
}

int bench_command(const BenchRequest& request) {
    const parallel::CancelToken& cancel = cli::cancel_by_signals();
    const int rounds = request.repeat.value_or(request.quick ? 1 : 3);
    const Plan plan = make_plan(parse_settings(request));
    std::optional<EarlierRun> earlier;
    if (!request.against.empty()) {
        earlier = read_earlier(request.against);
        check_comparable(*earlier, plan);
    }
    fs::path folder;
    cli::PlannedFiles files;
    if (!request.no_files) folder = report::prepare_folder(request.folder, report_files, files);
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
        return cli::exit_code_of(true);
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

void add_command(cli::Command& program) {
    cli::Command* command = program.add_subcommand("bench", "Measure the engine on fixed scenes, against its targets");
    auto request = std::make_shared<BenchRequest>();
    command->add_option("--only", request->only, "SECTION,...", "Only these sections, with commas between; see below");
    command->add_flag(
        "--quick", request->quick,
        "Small frames, few rays, one round: seconds, to see that all works; its counts are exact too, its times rough");
    command->add_option(
        "--repeat", request->repeat, 1, 1000, "R",
        "Rounds, each of every case once; the least and the median time count; default 3, with --quick 1");
    command->add_option("--against", request->against, "FILE.json",
                        "Print the ratio of this run to an earlier one's bench.json");
    command->add_flag("--peers", request->peers,
                      "POV-Ray and Embree too, as far as they are installed; the same as section peers");
    command->add_flag("--whole", request->whole,
                      "Whole frames: 1920x1080 at N = 10 is 207 M rays a case and round. Without it frames of more "
                      "than 1 M rays are measured in 16 fixed blocks, chosen to be like all of them");
    command->add_option("--rays", request->rays, 1, kMostRays, "R",
                        "Rays that a case's blocks have at most, nearly; one block at least");
    cli::add_simd(*command);
    command->add_option("-o,--output", request->folder, "DIR", "Folder for the report, made if it is not there")
        ->capture_default_str();
    command->add_flag("--no-files", request->no_files, "The table alone");
    cli::add_quiet(*command, request->quiet, "No progress and no table");
    command->footer(
        "Sections:\n" + sections_text() +
        "Writes bench.json, bench.txt (the table), bench.png and bench.svg. Times are CPU times of one thread, of all "
        "that a\nrender does but starting and writing; those of 'threads' are by the clock. 'evals/ray' counts shadow "
        "rays'\nand normals' evaluations too, over the camera's rays. Counts are the same in every run on a SIMD "
        "target; cases are\nmeasured in turns. Verdicts: 'PASS, aim', 'PASS' (the floor), 'SHORT'. They do not change "
        "the exit code.\n"
        "On SIGINT, SIGTERM or SIGHUP the table is of the rounds that are finished, and no file is written.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or a file that --against cannot compare, 129, "
        "130 or 143\ninterrupted.");
    command->action([request] { return bench_command(*request); });
}

}  // namespace strata::tools::bench
