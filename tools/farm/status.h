// How far a farm is, told from its folder alone and, where there is one, from Slurm's queue.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace strata::tools::farm {

enum class TaskState { done, running, waiting, failed };

struct Task {
    TaskState state = TaskState::waiting;
    int number = 0;
    int attempt = 0;     // 0: none yet
    std::string host;    // of the latest attempt; empty if there was none
    double seconds = 0;  // that it took, or, while it runs, since it began
    std::string reason;  // of what failed
};

// What Slurm has of a farm's tasks, by their number: "RUNNING", "PENDING".
using Queue = std::map<int, std::string>;

struct Status {
    std::string title, output;
    std::filesystem::path folder;
    std::vector<Task> tasks;
    Task last;  // which joins what they made
    bool is_cancelled = false;

    int count(TaskState state) const;
    bool any_failed() const { return count(TaskState::failed) > 0 || last.state == TaskState::failed; }

    // Seconds to the end of the tasks, as those went that are done; nothing before one is, or when none is under way.
    std::optional<double> left_s() const;
};

// Throws UsageError for what is no farm's folder.
Status read_status(const std::filesystem::path& folder);

std::string status_text(const Status& status);

// Slurm's numbers of a farm: of the array and of what follows it. Empty where it was not handed to Slurm.
std::vector<std::string> slurm_jobs(const std::filesystem::path& folder);

// Nothing where Slurm is not here, or does not answer, or has nothing to do with the farm.
std::optional<Queue> slurm_queue(const std::filesystem::path& folder, int last);

}  // namespace strata::tools::farm
