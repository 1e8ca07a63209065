#include "tools/job/picture_folder.h"

#include <fmt/format.h>

#include "src/image/write.h"
#include "tools/cli/standard_output.h"
#include "tools/job/already_there.h"
#include "tools/job/batch.h"

namespace strata::tools::job {

bool Outcome::is_whole(std::size_t pictures, bool quiet) const {
    if (cancelled && !quiet) {
        cli::print_out(fmt::format("stopped  with {} of {} pictures; the same command goes on from there\n",
                                   kept + rendered, pictures));
    }
    if (!cancelled && failed > 0) {
        cli::print_error(
            fmt::format("{} of {} pictures are there; the same command goes on from there", kept + rendered, pictures));
    }
    return !cancelled && failed == 0;
}

Outcome render_missing(const FolderWork& work, const std::vector<const FolderPicture*>& pictures, Ledger& ledger,
                       const std::function<void()>& written, const parallel::CancelToken& cancel) {
    Outcome outcome;
    Batch batch(work.threads, work.quiet, cancel);
    std::vector<const FolderPicture*> missing;
    for (const FolderPicture* picture : pictures) {
        if (is_kept(work.folder / picture->file, picture->metadata, picture->shape(), IfOther::replace, work.quiet)) {
            ++outcome.kept;
            continue;
        }
        missing.push_back(picture);
        batch.expect(*picture);
    }
    if (!work.quiet && outcome.kept > 0) {
        cli::print_out(missing.empty()
                           ? fmt::format("kept     all {} pictures: nothing to render\n", outcome.kept)
                           : fmt::format("kept     {} pictures, {} to render\n", outcome.kept, missing.size()));
    }
    for (const FolderPicture* picture : missing) {
        const auto rendered = batch.render(*picture);
        if (!rendered) break;
        const bool is_written = batch.write({work.folder / picture->file}, [&](const std::filesystem::path& path) {
            image::write_picture(path, rendered->picture, picture->metadata, picture->write);
        });
        ++(is_written ? outcome.rendered : outcome.failed);
        if (is_written) {
            ledger[picture->file] = cost_of(rendered->result, picture->metadata);
            written();
        }
        if (batch.is_stopped() || batch.is_failing()) break;
    }
    outcome.cancelled = batch.is_stopped();
    batch.clear_progress();
    batch.warn_of_unresolved();
    return outcome;
}

}  // namespace strata::tools::job
