#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "noise/simd_target.h"
#include "src/image/image_error.h"
#include "src/scene/key_text.h"
#include "src/scene/suggest.h"
#include "src/scene/typed_number.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/scene_argument.h"
#include "tools/cli/standard_output.h"
#include "tools/cli/status_line.h"
#include "tools/stability/report.h"
#include "tools/stability/run.h"

namespace strata::tools::stability {

namespace {

namespace fs = std::filesystem;

struct StabilityRequest {
    std::string folder, json, groups, seed = "1", threads = "0";
    bool fast = false, quiet = false;
};

struct Output {
    fs::path path;
    std::string (*text)(const std::vector<Row>&, const Heading&);
};

std::vector<std::string> parse_groups(const std::string& text) {
    const std::vector<std::string> known = groups();
    std::vector<std::string> chosen;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            const auto near = scene::nearest(name, known);
            throw cli::UsageError(fmt::format("--only: '{}' is no group, allowed: {}{}", name, fmt::join(known, ", "),
                                              near ? fmt::format(", did you mean '{}'?", *near) : ""));
        }
        chosen.push_back(name);
        begin = end + 1;
    }
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
    static parallel::CancelToken cancel;
    parallel::cancel_on_signals(cancel);
    const Settings settings{request.fast, parse_seed(request.seed), &cancel};
    const int threads = cli::parse_integer("--threads", request.threads, 0, 1024);
    const std::vector<Case> cases = cases_of(parse_groups(request.groups));
    cli::PlannedFiles files;
    const std::vector<Output> outputs = outputs_of(request, files);
    const Heading heading{fmt::format("{}", fmt::join(noise::simd_targets(), ", ")), settings.seed, settings.fast};
    cli::StatusLine line;
    const std::vector<Row> rows =
        run_cases(cases, settings, threads, [&](std::size_t done, std::size_t total, const Case& next) {
            if (!request.quiet) line.show(fmt::format("{}/{}  {}: {}", done, total, next.group, next.name));
        });
    line.clear();
    if (!request.quiet || failures(rows) > 0) cli::print_out(text_table(rows));
    if (cancel.requested()) {
        cli::print_error("interrupted: these are the cases that were finished; no file was written");
        return cli::kExitSignal + parallel::cancelling_signal();
    }
    for (const Output& output : outputs) {
        const bool written = files.write(output.path, output.text(rows, heading));
        if (written && !request.quiet) cli::print_out(fmt::format("wrote {}\n", output.path.string()));
    }
    return failures(rows) > 0 || !files.all_written() ? cli::kExitRuntime : 0;
}

}  // namespace

void add_command(cli::Command& program, int& exit_code) {
    cli::Command* command =
        program.add_subcommand("stability", "Check the arithmetic on stiff and extreme cases against derived bounds");
    auto request = std::make_shared<StabilityRequest>();
    command->add_option("-o,--output", request->folder, "Folder to write stability.md and stability.json to")
        ->type_name("FOLDER");
    command->add_option("--json", request->json, "Write the JSON to this file; - for standard output")
        ->type_name("FILE");
    command
        ->add_option("--only", request->groups,
                     fmt::format("Only these groups, separated by commas: {}", fmt::join(groups(), ", ")))
        ->type_name("GROUP,...");
    command->add_flag("--fast", request->fast, "Fewer inputs of every case: a few seconds");
    command->add_option("--seed", request->seed, "Of the random inputs; the table is the same for the same seed")
        ->capture_default_str()
        ->type_name("S");
    command->add_option("--threads", request->threads, "Threads, up to 1024; 0: as many as machine and container give")
        ->capture_default_str()
        ->type_name("n");
    command->add_flag("--quiet", request->quiet, "No progress, and no table unless something failed");
    command->footer(
        "Each row: what was measured, the bound that the arithmetic or a stated contract gives, and in the files the\n"
        "worst input, often as a command that replays it. Rows marked info document the paper's method or a limit.\n"
        "Exit codes: 0 all checks passed, 1 a check failed, 2 wrong command line, 129, 130 or 143 interrupted.");
    command->callback([request, &exit_code] { exit_code = stability_command(*request); });
}

}  // namespace strata::tools::stability
