#include "tools/report/machine.h"

#include <fstream>

namespace strata::tools::report {

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("model name")) continue;
        const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
        if (start != std::string::npos) return line.substr(start);
    }
    return "an unnamed processor";
}

}  // namespace strata::tools::report
