#include <array>
#include <cstdio>
#include <sstream>

#include "tools/cli/process.h"
#include "tools/cli/text_file.h"
#include "tools/farm/status.h"

namespace strata::tools::farm {

namespace fs = std::filesystem;

std::vector<std::string> slurm_jobs(const fs::path& folder) {
    std::string why;
    std::istringstream words(cli::read_text_file(folder / "jobs", why).value_or(""));
    std::string array, last;
    if (!(words >> array >> last)) return {};
    return {array, last};
}

std::optional<Queue> slurm_queue(const fs::path& folder, int last) {
    const std::vector<std::string> jobs = slurm_jobs(folder);
    if (jobs.empty() || cli::search_path("squeue").empty()) return std::nullopt;
    // All of the user's: those of a number that Slurm has forgotten would be an error.
    std::FILE* pipe = ::popen("squeue --me --noheader --array --format='%F %K %T' 2>/dev/null", "re");
    if (pipe == nullptr) return std::nullopt;
    std::string text;
    std::array<char, 4096> some;
    while (const std::size_t count = std::fread(some.data(), 1, some.size(), pipe)) text.append(some.data(), count);
    if (::pclose(pipe) != 0) return std::nullopt;
    Queue queue;
    std::istringstream lines(text);
    for (std::string job, index, state; lines >> job >> index >> state;) {
        if (job == jobs[0]) queue[std::atoi(index.c_str())] = state;
        if (job == jobs[1]) queue[last] = state;
    }
    return queue;
}

}  // namespace strata::tools::farm
