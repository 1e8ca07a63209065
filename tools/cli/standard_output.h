// Standard output that may be closed, on a full disk, or a pipe whose reader has gone.
#pragma once

#include <filesystem>
#include <string_view>

namespace strata::tools::cli {

// Call first. A closed standard stream is kept closed, so that no picture is opened in its place and gets its text;
// a full disk and a lost reader are errors of the write (EFBIG, EPIPE), not signals that end the program.
void guard_standard_streams();

// Messages go to standard error from now on: standard output is for a picture or a report, if that is where `path`
// leads.
void keep_output_for(const std::filesystem::path& path);

// Never throws: a failure is remembered for finish_output().
void print_out(std::string_view text);

// For whoever waits at the other end of a pipe. False once nothing more can be written.
bool flush_out();

// A line to standard error, after "strata: ". Never throws. Control characters, which names of files may hold and a
// terminal would obey, are shown as \u001B; those of print_out() are, where that is a terminal.
void print_error(std::string_view message);

// Flushes. exit_code, or that of a failure, with a message, if output was lost; a reader who has gone wanted no more.
int finish_output(int exit_code);

}  // namespace strata::tools::cli
