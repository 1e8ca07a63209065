// Other programs that strata hands work to: gnuplot for plots, ffmpeg for films.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace strata::tools::cli {

// A program that is not there, could not be started or failed. what() is for the user, the program's own words
// included.
class ProcessError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A program's path by PATH; empty if it is not there.
std::filesystem::path search_path(const std::string& name);

// The program's path by PATH. When it is not there, its section of tools/setup/packages.txt is installed, if that can
// be (installer.h): so ask only for what is certain to be used, after all else is checked. Throws ProcessError, naming
// the Debian package that has it, when it is not there then either.
std::filesystem::path find_program(const std::string& name, const std::string& debian_package,
                                   const std::string& section);

// A program that ended well.
struct ProgramRun {
    std::string output;  // the end of both streams' text: 4000 characters at least, if there are so many
    std::uint64_t peak_memory_bytes = 0;  // resident
};

// Runs a program to its end, its standard input empty. Its output is caught and shown only when it fails: throws
// ProcessError then, and when it could not be started. It ends with this process (end_programs()), and ignores
// what this one ignores.
ProgramRun run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments);

// Sends a signal to the programs that are running. Async-signal-safe.
void end_programs(int signal) noexcept;

}  // namespace strata::tools::cli
