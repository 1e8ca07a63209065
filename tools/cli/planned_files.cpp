#include "tools/cli/planned_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/image/file_paths.h"
#include "src/image/stream_target.h"
#include "tools/cli/errors.h"

namespace strata::tools::cli {

namespace fs = std::filesystem;

void PlannedFiles::plan(const fs::path& path) {
    const auto is_planned = [&](const image::OutputFile& file) { return image::is_one_file(file.target(), path); };
    if (std::ranges::any_of(files_, is_planned)) {
        throw UsageError(fmt::format("{}: allowed: a file of its own; another output is the same", path.string()));
    }
    image::check_replaceable(path);
    files_.emplace_back(path);
}

bool PlannedFiles::write(const fs::path& path, std::string_view text) {
    return write_made(path,
                      [&] { return std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()); });
}

bool PlannedFiles::note(bool written) {
    all_written_ = all_written_ && written;
    return written;
}

void PlannedFiles::put(const fs::path& path, std::span<const unsigned char> bytes) {
    const auto file = std::ranges::find(files_, path, &image::OutputFile::target);
    // One that was not planned, or is written once more.
    if (file == files_.end()) return image::replace_file(path, bytes);
    file->write_at(0, bytes);
    file->put_in_place();
    files_.erase(file);
}

void refuse_shared(const std::vector<NamedOutput>& outputs) {
    for (std::size_t i = 1; i < outputs.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const auto& [name, path] = outputs[i];
            const bool both_standard = image::is_standard_output(path) && image::is_standard_output(outputs[k].path);
            if (!both_standard && !image::is_one_file(path, outputs[k].path)) continue;
            throw UsageError(fmt::format("{}: allowed: a file of its own; {} is the same", name, outputs[k].name));
        }
    }
}

}  // namespace strata::tools::cli
