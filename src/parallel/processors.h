// What of the machine this process may use: containers and services are given a share of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace strata::parallel {

// The limits of the control groups (Linux cgroups, version 1 and 2) that this process is in, and of those around it.
struct GroupLimits {
    std::optional<double> processors;           // the CPU time a second of wall time
    std::optional<std::uint64_t> memory_bytes;  // resident
};

// root: where /proc and /sys are looked for.
GroupLimits group_limits(const std::filesystem::path& root = "/");

// The least of the machine's processors, those this process is bound to (taskset) and the groups' CPU quota, rounded
// up; 1 at least.
int available_processors();

// The least of the machine's memory and the groups' limit.
std::uint64_t available_memory_bytes();

}  // namespace strata::parallel
