#include "src/parallel/processors.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace strata::parallel {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// The numbers of a file; none for "max" and from there on.
std::vector<double> numbers_of(const fs::path& path) {
    std::istringstream words(text_of(path));
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    return numbers;
}

template <class T>
void take_least(std::optional<T>& least, T value) {
    least = least ? std::min(*least, value) : value;
}

void take_quota(std::optional<double>& processors, double quota_us, double period_us) {
    if (quota_us > 0 && period_us > 0) take_least(processors, quota_us / period_us);
}

// "max 100000" or "50000 100000".
void take_cpu_2(const fs::path& group, GroupLimits& limits) {
    const std::vector<double> words = numbers_of(group / "cpu.max");
    if (words.size() == 2) take_quota(limits.processors, words[0], words[1]);
}

// No quota is -1.
void take_cpu_1(const fs::path& group, GroupLimits& limits) {
    const std::vector<double> quota = numbers_of(group / "cpu.cfs_quota_us"),
                              period = numbers_of(group / "cpu.cfs_period_us");
    if (quota.size() == 1 && period.size() == 1) take_quota(limits.processors, quota[0], period[0]);
}

// No limit is "max", or in version 1 a number near 2^63.
void take_memory(const fs::path& file, GroupLimits& limits) {
    constexpr double kNone = 0x1p62;
    const std::vector<double> bytes = numbers_of(file);
    if (bytes.size() == 1 && bytes[0] >= 0 && bytes[0] < kNone) {
        take_least(limits.memory_bytes, static_cast<std::uint64_t>(bytes[0]));
    }
}

// One line of /proc/self/cgroup: "0::/user.slice" (version 2) or "4:cpu,cpuacct:/docker/9f".
struct Membership {
    std::vector<std::string> controllers;
    std::string path;

    bool has(const std::string& controller) const {
        return std::find(controllers.begin(), controllers.end(), controller) != controllers.end();
    }
};

std::vector<Membership> memberships(const fs::path& root) {
    std::vector<Membership> found;
    std::istringstream lines(text_of(root / "proc/self/cgroup"));
    for (std::string line; std::getline(lines, line);) {
        const auto first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        Membership membership{{}, line.substr(second + 1)};
        std::istringstream names(line.substr(first + 1, second - first - 1));
        for (std::string name; std::getline(names, name, ',');) membership.controllers.push_back(name);
        found.push_back(std::move(membership));
    }
    return found;
}

// The group's folder and those around it up to the hierarchy's top. In a container the path may be that of the host and
// lead nowhere; the container's own group is then the top.
template <class Take>
void for_groups(const fs::path& hierarchy, const std::string& path, Take take) {
    fs::path group = fs::path(path).relative_path();
    while (!group.empty()) {
        take(hierarchy / group);
        if (!group.has_parent_path()) break;
        group = group.parent_path();
    }
    take(hierarchy);
}

}  // namespace

GroupLimits group_limits(const fs::path& root) {
    GroupLimits limits;
    const fs::path groups = root / "sys/fs/cgroup";
    for (const Membership& member : memberships(root)) {
        if (member.controllers.empty()) {
            // Version 2 lies there alone, or beside version 1.
            for (const fs::path& hierarchy : {groups, groups / "unified"}) {
                for_groups(hierarchy, member.path, [&](const fs::path& group) {
                    take_cpu_2(group, limits);
                    take_memory(group / "memory.max", limits);
                });
            }
        }
        if (member.has("cpu")) {
            for (const char* name : {"cpu", "cpu,cpuacct"}) {
                for_groups(groups / name, member.path, [&](const fs::path& group) { take_cpu_1(group, limits); });
            }
        }
        if (member.has("memory")) {
            for_groups(groups / "memory", member.path,
                       [&](const fs::path& group) { take_memory(group / "memory.limit_in_bytes", limits); });
        }
    }
    return limits;
}

int available_processors() {
    int count = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    cpu_set_t bound;
    CPU_ZERO(&bound);
    if (::sched_getaffinity(0, sizeof bound, &bound) == 0 && CPU_COUNT(&bound) > 0) {
        count = std::min(count, CPU_COUNT(&bound));
    }
    if (const auto quota = group_limits().processors) {
        count = static_cast<int>(std::min<double>(count, std::ceil(*quota)));
    }
    return std::max(1, count);
}

std::uint64_t available_memory_bytes() {
    const double machine =
        static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    const auto present = static_cast<std::uint64_t>(std::max(machine, 0.0));
    return std::min(present, group_limits().memory_bytes.value_or(std::numeric_limits<std::uint64_t>::max()));
}

}  // namespace strata::parallel
