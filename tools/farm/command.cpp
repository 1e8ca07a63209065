#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "src/image/output_file.h"
#include "src/scene/key_text.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/process.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/shell_word.h"
#include "tools/cli/standard_output.h"
#include "tools/farm/folder.h"
#include "tools/farm/status.h"

namespace strata::tools::farm {

namespace {

void check_engine(const Request& request) {
    if (request.engine != "slurm" && request.engine != "parallel") {
        throw cli::UsageError(fmt::format("--engine {}: allowed: slurm, parallel", scene::excerpt(request.engine)));
    }
    if (request.engine == "slurm" && !request.hosts.empty()) {
        throw cli::UsageError("--hosts: allowed with --engine parallel; Slurm has its own");
    }
    if (request.engine == "parallel" && !request.sbatch.empty()) {
        throw cli::UsageError("--sbatch: allowed with --engine slurm");
    }
}

// This process becomes the folder's own script: signals and its end are the engine's.
void start(const std::filesystem::path& folder) {
    const std::string script = (folder / "start").string();
    std::fflush(nullptr);
    ::execl(script.c_str(), script.c_str(), nullptr);
    throw cli::ProcessError(fmt::format("{}: cannot be started", script));
}

void submit(const Request& request, bool is_only_planned) {
    check_engine(request);
    if (request.engine == "parallel" && !is_only_planned) cli::find_program("parallel", "parallel", "farm");
    const Plan plan = make_plan(request);
    write_folder(plan, request);
    cli::print_out(fmt::format("planned  {}: {} tasks, --simd {}; strata farm status {}\n", plan.folder.string(),
                               plan.tasks(), plan.simd, cli::shell_word(plan.folder.string())));
    const bool can_start = request.engine == "parallel" || !cli::search_path("sbatch").empty();
    if (can_start && !is_only_planned) return start(plan.folder);
    cli::print_out(fmt::format("{}start it by {}\n",
                               can_start ? "" : "there is no sbatch here; on a machine that has it ",
                               cli::shell_word((plan.folder / "start").string())));
}

int tell_status(const std::string& folder) {
    const Status status = read_status(folder);
    cli::print_out(status_text(status));
    return status.any_failed() ? cli::kExitRuntime : 0;
}

// The file stops tasks wherever they run; Slurm's own are also taken from its queue.
void cancel(const std::string& folder) {
    read_status(folder);
    image::replace_file(std::filesystem::path(folder) / "cancelled", "");
    const std::vector<std::string> jobs = slurm_jobs(folder);
    const std::filesystem::path scancel = cli::search_path("scancel");
    if (!jobs.empty() && !scancel.empty()) cli::run_program(scancel, jobs);
    cli::print_out(fmt::format("cancelled; {}/start goes on where it was\n", folder));
}

void add_submit(cli::Command& farm) {
    cli::Command* command = farm.add_subcommand("submit", "Cut a picture or an animation into tasks and start them");
    auto request = std::make_shared<Request>();
    auto is_only_planned = std::make_shared<bool>(false);
    request->picture.scene.add_to(*command);
    command
        ->add_option("-o,--output", request->output, "FILE",
                     "What is made: an EXR of --shards; frames (NAME.####.png) or a film of --frames")
        ->required();
    command->add_option("--shards", request->shards, 1, kMostTasks, "n",
                        "Parts that a picture is rendered in, 1 to 1000; default 8");
    command->add_option("--frames", request->frames, "A-BxS,...", "Frames, as of `strata animate`, instead");
    command->add_option("--engine", request->engine, "NAME", "slurm, or parallel: GNU Parallel here or by ssh")
        ->capture_default_str();
    command->add_option("--hosts", request->hosts, "HOST,...",
                        "Machines of --engine parallel, as its --sshlogin takes them, : is this one; default this one");
    command
        ->add_option("--sbatch", request->sbatch, "OPTION", "For sbatch: --sbatch=--partition=long (may be repeated)")
        ->repeated();
    command->add_option("--folder", request->folder, "DIR",
                        "The farm's, seen by all machines by this name; default FILE.farm");
    command->add_flag("--plan", *is_only_planned, "Write the folder and start nothing");
    command->add_option("--threads", request->picture.threads, 0, 1024, "n", "Threads of a task; 0 and default: one");
    render::add_picture_options(*command, request->picture);
    command->footer(
        "Each task is a process of this very program, by its path, with settings frozen in DIR/scene.toml and "
        "DIR/commands\nand one SIMD target: this machine's best, or that of --simd, which all machines must have. The "
        "whole is, byte for\nbyte, what one process writes. A task that fails or whose machine is lost is begun anew, "
        "three times at most;\nDIR/start goes on with all that is not done.");
    command->action([request, is_only_planned] { submit(*request, *is_only_planned); });
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* farm = program.add_subcommand("farm", "Render on many machines, by Slurm or GNU Parallel");
    farm->require_subcommand();
    add_submit(*farm);
    auto folder = std::make_shared<std::string>();
    cli::Command* status = farm->add_subcommand("status", "Tell how far a farm is; exit code 1 when a task has failed");
    status->add_option("DIR", *folder, "", "The farm's folder")->required();
    status->action([folder] { return tell_status(*folder); });
    cli::Command* stop = farm->add_subcommand("cancel", "Stop a farm's tasks; what is finished is kept");
    stop->add_option("DIR", *folder, "", "The farm's folder")->required();
    stop->action([folder] { cancel(*folder); });
}

}  // namespace strata::tools::farm
