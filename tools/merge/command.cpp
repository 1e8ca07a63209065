#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "src/image/file_paths.h"
#include "src/image/format.h"
#include "src/image/output_file.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/standard_output.h"
#include "tools/merge/whole.h"

namespace strata::tools::merge {

namespace {

struct Request {
    std::vector<std::string> parts;
    std::string output;
    bool quiet = false;
};

void check_output(const Request& request) {
    if (image::format_of(request.output) != image::Format::exr) {
        throw cli::UsageError(fmt::format("-o {}: allowed: .exr", request.output));
    }
    for (const std::string& part : request.parts) {
        if (!image::is_one_file(part, request.output)) continue;
        throw cli::UsageError(fmt::format("-o {}: allowed: another file than the parts", request.output));
    }
    image::check_writable(request.output);
    cli::keep_output_for(request.output);
}

void merge(const Request& request) {
    check_output(request);
    const Parts parts = find_parts(request.parts);
    cli::ProgressPrinter printer(request.quiet);
    const auto start = std::chrono::steady_clock::now();
    const parallel::ProgressCallback progress = printer.callback();
    const auto tell = [&](double fraction) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        if (progress) progress({fraction, 0, passed.count()});
    };
    const auto warn = [&](const std::string& text) {
        if (!request.quiet) cli::print_error("warning: " + text);
    };
    write_whole(parts, request.output, tell, warn);
    printer.clear();
    if (!request.quiet) cli::print_out(fmt::format("wrote    {}\n", request.output));
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command = program.add_subcommand("merge", "Put the parts of a picture together");
    auto request = std::make_shared<Request>();
    command->add_option("PART", request->parts, "EXR", "EXRs of `render --shard i/n`, all n of them in any order")
        ->required();
    command->add_option("-o,--output", request->output, "FILE.exr", "The whole picture, an EXR")->required();
    command->add_flag("--quiet", request->quiet, "No progress or warnings");
    command->footer(
        "The whole is the very file, byte for byte, that one render of it would have written, wherever and in "
        "whatever\n"
        "order the parts were made. Parts of other settings, another version or another SIMD target are refused, and "
        "so\n"
        "are parts that are missing, damaged, unfinished, or there twice and different; the same part twice is taken "
        "once.\n"
        "Memory does not grow with the height. Pictures of AOVs are not written, their channels are.");
    command->action([request] { merge(*request); });
}

}  // namespace strata::tools::merge
