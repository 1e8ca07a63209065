#include "tools/sweep/render.h"

#include <fmt/format.h>

#include <vector>

#include "src/image/write.h"
#include "tools/cli/standard_output.h"
#include "tools/job/already_there.h"
#include "tools/job/batch.h"
#include "tools/sweep/tables.h"

namespace strata::tools::sweep {

namespace {

std::vector<const Picture*> pictures_of(const Job& job) {
    std::vector<const Picture*> pictures;
    for (const Cell& cell : job.cells) pictures.push_back(&cell.picture);
    for (const Reference& reference : job.references)
        for (const Picture& half : reference.halves) pictures.push_back(&half);
    return pictures;
}

}  // namespace

Outcome render_sweep(cli::PlannedFiles& files, const Job& job, Ledger& ledger, const parallel::CancelToken& cancel) {
    Outcome outcome;
    job::Batch batch(job.threads, job.quiet, cancel);
    std::vector<const Picture*> missing;
    for (const Picture* picture : pictures_of(job)) {
        if (job::is_kept(job.folder / picture->file, picture->metadata, picture->shape(), job::IfOther::replace,
                         job.quiet)) {
            ++outcome.kept;
            continue;
        }
        missing.push_back(picture);
        batch.expect(*picture);
    }
    if (!job.quiet && outcome.kept > 0) {
        cli::print_out(missing.empty()
                           ? fmt::format("kept     all {} pictures: nothing to render\n", outcome.kept)
                           : fmt::format("kept     {} pictures, {} to render\n", outcome.kept, missing.size()));
    }
    for (const Picture* picture : missing) {
        const auto rendered = batch.render(*picture);
        if (!rendered) break;
        const bool is_written = batch.write({job.folder / picture->file}, [&](const std::filesystem::path& path) {
            image::write_picture(path, rendered->picture, picture->metadata, picture->float_exr());
        });
        ++(is_written ? outcome.rendered : outcome.failed);
        if (is_written) {
            ledger[picture->file] = cost_of(rendered->result, picture->metadata);
            write_costs(files, job, ledger);
        }
        if (batch.is_stopped() || batch.is_failing()) break;
    }
    outcome.cancelled = batch.is_stopped();
    batch.clear_progress();
    batch.warn_of_unresolved();
    return outcome;
}

}  // namespace strata::tools::sweep
