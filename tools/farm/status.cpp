#include "tools/farm/status.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <sstream>

#include "tools/cli/errors.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/text_file.h"
#include "tools/report/json.h"

namespace strata::tools::farm {

namespace fs = std::filesystem;

namespace {

// A task touches its state every 5 s (task.sh); folders of other machines are seen some seconds late.
constexpr double kSilence_s = 60;

double age_s(const fs::path& path) {
    std::error_code error;
    const auto time = fs::last_write_time(path, error);
    if (error) return 0;
    return std::chrono::duration<double>(fs::file_time_type::clock::now() - time).count();
}

double now_s() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

// What Slurm says of a task whose state is that of its latest attempt.
void ask_queue(Task& task, const Queue& queue) {
    const auto found = queue.find(task.number);
    if (found == queue.end()) {
        if (task.state != TaskState::failed) task.reason = "it ended without a word, and Slurm has it no more";
        task.state = TaskState::failed;
    } else if (found->second == "RUNNING" || found->second == "COMPLETING") {
        if (task.state == TaskState::waiting && task.attempt > 0) task.state = TaskState::running;
    } else {
        task.state = TaskState::waiting;
    }
}

Task read_task(const fs::path& folder, int number, const std::optional<Queue>& queue) {
    Task task;
    task.number = number;
    std::string why, word;
    const fs::path path = folder / "tasks" / fmt::format("{}.state", number);
    if (const auto done = cli::read_text_file(folder / "tasks" / fmt::format("{}.done", number), why)) {
        std::istringstream words(*done);
        words >> task.seconds >> task.host;
        task.seconds /= 1000;
        task.state = TaskState::done;
        return task;
    }
    if (const auto text = cli::read_text_file(path, why)) {
        std::istringstream words(*text);
        words >> word >> task.attempt >> task.host >> std::ws;
        std::getline(words, task.reason);
        task.state = word == "running" ? TaskState::running : TaskState::failed;
        if (task.reason == "cancelled") task.attempt = 0, task.state = TaskState::waiting;
    }
    if (task.state == TaskState::running) {
        task.seconds = std::max(0.0, now_s() - std::atof(task.reason.c_str()));
        task.reason.clear();
        const double silence = age_s(path);
        if (!queue && silence > kSilence_s) {
            task.state = TaskState::failed;
            task.reason = fmt::format("no sign of life for {}", cli::duration_text(silence));
        }
    }
    if (queue) ask_queue(task, *queue);
    return task;
}

std::string task_text(const Status& status, const Task& task) {
    return fmt::format("{}{}: {}; {}", task.number == status.last.number ? "the last" : fmt::format("{}", task.number),
                       task.attempt > 0 ? fmt::format(", attempt {} on {}", task.attempt, task.host) : "", task.reason,
                       (status.folder / "tasks" / fmt::format("{}.log", task.number)).string());
}

std::string running_text(const Status& status) {
    constexpr int kMostShown = 8;
    std::string text;
    int shown = 0;
    for (const Task& task : status.tasks) {
        if (task.state != TaskState::running || ++shown > kMostShown) continue;
        text += fmt::format("{}{} on {} for {}", text.empty() ? ": " : ", ", task.number, task.host,
                            cli::duration_text(task.seconds));
    }
    return text + (shown > kMostShown ? fmt::format(" and {} more", shown - kMostShown) : "");
}

const char* name_of(TaskState state) {
    constexpr const char* kNames[] = {"done", "running", "waiting", "failed"};
    return kNames[static_cast<int>(state)];
}

}  // namespace

int Status::count(TaskState state) const { return static_cast<int>(std::ranges::count(tasks, state, &Task::state)); }

std::optional<double> Status::left_s() const {
    const int done = count(TaskState::done), running = count(TaskState::running);
    if (done == 0 || running == 0) return std::nullopt;
    double mean = 0, work = 0;
    for (const Task& task : tasks) mean += task.state == TaskState::done ? task.seconds / done : 0;
    for (const Task& task : tasks) {
        if (task.state == TaskState::waiting) work += mean;
        if (task.state == TaskState::running) work += std::max(0.0, mean - task.seconds);
    }
    return work / running;
}

Status read_status(const fs::path& folder) {
    std::string why;
    const auto text = cli::read_text_file(folder / "plan.json", why);
    const auto plan = report::Json::parse(text.value_or(""), nullptr, false);
    const int tasks =
        plan.is_object() && plan.contains("tasks") && plan["tasks"].is_number() ? plan["tasks"].get<int>() : 0;
    if (tasks < 1) throw cli::UsageError(fmt::format("{}: it is no folder of `strata farm submit`", folder.string()));
    Status status;
    status.folder = folder;
    status.title = plan.value("title", "");
    status.output = plan.value("output", "");
    status.is_cancelled = fs::exists(folder / "cancelled");
    const std::optional<Queue> queue = slurm_queue(folder, tasks + 1);
    for (int number = 1; number <= tasks; ++number) status.tasks.push_back(read_task(folder, number, queue));
    status.last = read_task(folder, tasks + 1, queue);
    // Slurm drops it when a task has failed.
    if (status.last.attempt == 0 && status.last.state == TaskState::failed) status.last.state = TaskState::waiting;
    return status;
}

std::string status_text(const Status& status) {
    std::string text = fmt::format("{}\n", status.title);
    text += fmt::format("done     {} of {}\n", status.count(TaskState::done), status.tasks.size());
    text += fmt::format("running  {}{}\n", status.count(TaskState::running), running_text(status));
    text += fmt::format("waiting  {}{}\n", status.count(TaskState::waiting), status.is_cancelled ? ", cancelled" : "");
    text += fmt::format("failed   {}\n", status.count(TaskState::failed));
    for (const Task& task : status.tasks) {
        if (task.state == TaskState::failed) text += fmt::format("         {}\n", task_text(status, task));
    }
    text += fmt::format("the last {}: {}\n", name_of(status.last.state), status.output);
    if (status.last.state == TaskState::failed) text += fmt::format("         {}\n", task_text(status, status.last));
    if (const auto left = status.left_s()) {
        const auto end =
            std::chrono::system_clock::to_time_t(std::chrono::system_clock::now()) + static_cast<std::time_t>(*left);
        text += fmt::format("left     some {}, until {:%H:%M:%S}\n", cli::duration_text(*left), fmt::localtime(end));
    }
    return text;
}

}  // namespace strata::tools::farm
