#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "noise/simd_target.h"
#include "src/image/image_error.h"
#include "src/scene/key_text.h"
#include "src/scene/typed_number.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/cli/status_line.h"
#include "tools/stability/report.h"
#include "tools/stability/run.h"

namespace strata::tools::stability {

namespace {

namespace fs = std::filesystem;

struct StabilityRequest {
    std::string folder, json;
    std::vector<std::string> groups;
    std::uint64_t seed = 1;
    int threads = 0;
    bool fast = false, quiet = false;
};

struct Output {
    fs::path path;
    std::string (*text)(const std::vector<Row>&, const Heading&);
};

std::vector<std::string> parse_groups(const std::string& text) {
    const std::vector<std::string> known = groups();
    std::vector<std::string> chosen;
    for (const std::size_t i : cli::parse_names("--only", "group", text, known)) chosen.push_back(known[i]);
    return chosen;
}

std::uint64_t parse_seed(const std::string& text) {
    if (const auto seed = scene::typed_integer<std::uint64_t>(text)) return *seed;
    throw cli::UsageError(fmt::format("--seed {}: allowed: an integer from 0 to 2^64 - 1", scene::excerpt(text)));
}

// The files to write, their folder made and their writing tried, before any work.
std::vector<Output> outputs_of(const StabilityRequest& request, cli::PlannedFiles& files) {
    std::vector<Output> outputs;
    if (!request.folder.empty()) {
        const fs::path folder(request.folder);
        std::error_code error;
        fs::create_directories(folder, error);
        if (error)
            throw image::ImageError(fmt::format("cannot make folder \"{}\": {}", folder.string(), error.message()));
        outputs.push_back({folder / "stability.md", markdown_table});
        outputs.push_back({folder / "stability.json", json_table});
    }
    if (!request.json.empty()) outputs.push_back({request.json, json_table});
    for (const Output& output : outputs) files.plan(output.path);
    cli::keep_output_for(request.json);
    return outputs;
}

int stability_command(const StabilityRequest& request) {
    const parallel::CancelToken& cancel = cli::cancel_by_signals();
    const Settings settings{request.fast, request.seed, &cancel};
    const std::vector<Case> cases = cases_of(request.groups);
    cli::PlannedFiles files;
    const std::vector<Output> outputs = outputs_of(request, files);
    const Heading heading{fmt::format("{}", fmt::join(noise::simd_targets(), ", ")), settings.seed, settings.fast};
    cli::StatusLine line;
    const std::vector<Row> rows =
        run_cases(cases, settings, request.threads, [&](std::size_t done, std::size_t total, const Case& next) {
            if (!request.quiet) line.show(fmt::format("{}/{}  {}: {}", done, total, next.group, next.name));
        });
    line.clear();
    if (!request.quiet || failures(rows) > 0) cli::print_out(text_table(rows));
    if (cancel.requested()) {
        cli::print_error("interrupted: these are the cases that were finished; no file was written");
        return cli::exit_code_of(true);
    }
    for (const Output& output : outputs) {
        const bool written = files.write(output.path, output.text(rows, heading));
        if (written && !request.quiet) cli::print_out(fmt::format("wrote {}\n", output.path.string()));
    }
    return failures(rows) > 0 || !files.all_written() ? cli::kExitRuntime : 0;
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command =
        program.add_subcommand("stability", "Check the arithmetic on stiff and extreme cases against derived bounds");
    auto request = std::make_shared<StabilityRequest>();
    command->add_option("-o,--output", request->folder, "FOLDER", "Folder to write stability.md and stability.json to");
    command->add_option("--json", request->json, "FILE", "Write the JSON to this file; - for standard output");
    command->add_option(
        "--only", [request](const std::string& text) { request->groups = parse_groups(text); }, "GROUP,...",
        fmt::format("Only these groups, separated by commas: {}", fmt::join(groups(), ", ")));
    command->add_flag("--fast", request->fast, "Fewer inputs of every case: a few seconds");
    command
        ->add_option(
            "--seed", [request](const std::string& text) { request->seed = parse_seed(text); }, "S",
            "Of the random inputs; the table is the same for the same seed")
        ->default_str("1");
    cli::add_threads(*command, request->threads);
    cli::add_quiet(*command, request->quiet, "No progress, and no table unless something failed");
    command->footer(
        "Each row: what was measured, the bound that the arithmetic or a stated contract gives, and in the files the\n"
        "worst input, often as a command that replays it. Rows marked info document the paper's method or a limit.\n"
        "Exit codes: 0 all checks passed, 1 a check failed, 2 wrong command line, 129, 130 or 143 interrupted.");
    command->action([request] { return stability_command(*request); });
}

}  // namespace strata::tools::stability
