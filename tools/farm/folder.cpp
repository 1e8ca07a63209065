#include "tools/farm/folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include "src/image/output_file.h"
#include "tools/cli/errors.h"
#include "tools/cli/process.h"
#include "tools/cli/shell_word.h"
#include "tools/job/program_id.h"
#include "tools/report/json.h"

namespace strata::tools::farm {

namespace fs = std::filesystem;

namespace {

std::string plan_json(const Plan& plan, const Request& request) {
    return report::text_of({{"title", plan.title},
                            {"output", plan.output.string()},
                            {"tasks", plan.tasks()},
                            {"engine", request.engine},
                            {"program", plan.program.string()},
                            {"version", job::program_id()},
                            {"simd", plan.simd}});
}

// Tasks and, behind those that all went well, the last one: that of the merge. Slurm is asked to begin tasks anew whose
// node was lost, and to forget the last one when a task has failed for good.
std::string slurm_lines(const Plan& plan, const Request& request) {
    std::string options = fmt::format("--parsable --requeue --open-mode=append --chdir={} --cpus-per-task={}",
                                      cli::shell_word(plan.folder.string()), std::max(1, request.picture.threads));
    for (const std::string& option : request.sbatch) options += " " + cli::shell_word(option);
    const std::string name = cli::shell_word("--job-name=" + plan.output.filename().string());
    return fmt::format(
        "array=$(sbatch {0} {1} --array=1-{2} --output=tasks/%a.log --wrap 'exec ./task.sh')\n"
        "array=${{array%%;*}}\n"
        "last=$(sbatch {0} {1} --dependency=afterok:\"$array\" --kill-on-invalid-dep=yes --output=tasks/{3}.log \\\n"
        "    --wrap 'exec ./task.sh {3}')\n"
        "printf '%s %s\\n' \"$array\" \"${{last%%;*}}\" >jobs\n"
        "echo \"submitted as Slurm's jobs $(<jobs)\"\n",
        options, name, plan.tasks(), plan.tasks() + 1);
}

// A task at a time on every core, or on as many as a task has threads. A task that fails is tried again, on another
// machine if there is one, three times at most.
std::string parallel_lines(const Plan& plan, const Request& request) {
    const int percent = std::max(1, 100 / std::max(1, request.picture.threads));
    std::string hosts;
    if (!request.hosts.empty()) {
        hosts = fmt::format("--sshlogin {} --ssh 'ssh -o BatchMode=yes -o ServerAliveInterval=10' ",
                            cli::shell_word(request.hosts));
    }
    return fmt::format(
        "parallel --will-cite --jobs {}% --retries 4 {}{} {{}} ::: {{1..{}}} </dev/null\n"
        "for attempt in 1 2 3 4; do ! ./task.sh {} || exit 0; done\n"
        "exit 1\n",
        percent, hosts, cli::shell_word(cli::shell_word((plan.folder / "task.sh").string())), plan.tasks(),
        plan.tasks() + 1);
}

std::string start_script(const Plan& plan, const Request& request) {
    return fmt::format(
        "#!/usr/bin/env bash\n"
        "# Hands all tasks to their engine. What is done stays done, so that this may be run again, to go on.\n"
        "set -euo pipefail\n"
        "cd -- {}\n"
        "rm -f cancelled tasks/*.state\n{}",
        cli::shell_word(plan.folder.string()),
        request.engine == "slurm" ? slurm_lines(plan, request) : parallel_lines(plan, request));
}

void write(const fs::path& path, const std::string& text, bool is_program = false) {
    image::replace_file(path, text);
    if (is_program) {
        fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                        fs::perm_options::add);
    }
}

void fill(const fs::path& folder, const Plan& plan, const Request& request) {
    fs::create_directories(folder / "parts");
    fs::create_directories(folder / "tasks");
    std::string commands;
    for (const std::string& command : plan.commands) commands += command + "\n";
    write(folder / "commands", commands);
    write(folder / "scene.toml", plan.scene);
    write(folder / "plan.json", plan_json(plan, request));
    write(folder / "program.sha256", cli::run_program(cli::search_path("sha256sum"), {plan.program.string()}).output);
    write(folder / "task.sh", task_script(), true);
    write(folder / "start", start_script(plan, request), true);
}

}  // namespace

void write_folder(const Plan& plan, const Request& request) {
    if (fs::exists(plan.folder)) {
        throw cli::UsageError(
            fmt::format("{0}: is there already; {0}/start goes on with it, and without it, it is planned anew",
                        plan.folder.string()));
    }
    const fs::path beside = plan.folder.string() + fmt::format(".{}", ::getpid());
    try {
        fill(beside, plan, request);
        fs::rename(beside, plan.folder);
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(beside, ignored);
        throw;
    }
}

}  // namespace strata::tools::farm
