// The files that a command writes when its work is done: begun before it, so that what keeps one from being written is
// found out first, and each failing alone.
#pragma once

#include <exception>
#include <filesystem>
#include <list>
#include <new>
#include <span>
#include <string_view>
#include <vector>

#include "src/image/output_file.h"
#include "tools/cli/endings.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::cli {

// Runs write(); a failure is told and keeps no other file from being written.
template <class Write>
bool is_written(const std::filesystem::path& path, const Write& write) {
    try {
        write();
        return true;
    } catch (const std::bad_alloc&) {
        print_error("out of memory while writing \"" + path.string() + "\"");
    } catch (const std::exception& error) {
        print_error(message_of(error));
    }
    return false;
}

class PlannedFiles {
  public:
    // Begins the file. Throws ImageError as image::check_replaceable() does, UsageError for one that is planned
    // already.
    void plan(const std::filesystem::path& path);

    // Puts a planned file in place. A failure is told on standard error.
    bool write(const std::filesystem::path& path, std::string_view text);

    // The same of the bytes that make() gives; what it throws is the file's failure.
    template <class Make>
    bool write_made(const std::filesystem::path& path, const Make& make) {
        return note(is_written(path, [&] { put(path, make()); }));
    }

    // False if one of them could not be written.
    bool all_written() const { return all_written_; }

  private:
    bool note(bool written);
    void put(const std::filesystem::path& path, std::span<const unsigned char> bytes);

    std::list<image::OutputFile> files_;
    bool all_written_ = true;
};

// An output as it is told to users, "--stats s.json", and its file.
struct NamedOutput {
    std::string name;
    std::filesystem::path path;
};

// Throws UsageError, naming both, where two outputs are one file or both standard output.
void refuse_shared(const std::vector<NamedOutput>& outputs);

}  // namespace strata::tools::cli
