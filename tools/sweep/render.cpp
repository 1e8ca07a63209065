#include "tools/sweep/render.h"

#include <fmt/format.h>

#include <vector>

#include "src/image/picture_metadata.h"
#include "src/image/write.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/standard_output.h"
#include "tools/job/already_there.h"
#include "tools/job/batch_progress.h"
#include "tools/job/render_picture.h"
#include "tools/sweep/tables.h"

namespace strata::tools::sweep {

namespace {

constexpr int kMostFailures = 2;

std::vector<const SweepPicture*> pictures_of(const SweepJob& job) {
    std::vector<const SweepPicture*> pictures;
    for (const SweepCell& cell : job.cells) pictures.push_back(&cell.picture);
    for (const SweepReference& reference : job.references)
        for (const SweepPicture& half : reference.halves) pictures.push_back(&half);
    return pictures;
}

double rays_of(const SweepPicture& picture) { return job::expected_rays(picture.scene, picture.window); }

bool is_there(const SweepJob& job, const SweepPicture& picture) {
    const scene::Film& frame = picture.scene.film;
    const film::Rect& w = picture.window;
    const std::filesystem::path path = job.folder / picture.file;
    const job::Found found =
        job::find_picture(path, picture.metadata, {frame.width, frame.height, w.x0, w.y0, w.x1, w.y1});
    if (found.presence == job::Presence::damaged && !job.quiet) job::tell_damaged(path, found);
    return found.presence == job::Presence::same;
}

}  // namespace

SweepOutcome render_sweep(cli::PlannedFiles& files, const SweepJob& job, SweepLedger& ledger,
                          const parallel::CancelToken& cancel) {
    SweepOutcome outcome;
    std::vector<const SweepPicture*> missing;
    double total = 0;
    for (const SweepPicture* picture : pictures_of(job)) {
        if (is_there(job, *picture)) {
            ++outcome.kept;
            continue;
        }
        missing.push_back(picture);
        total += rays_of(*picture);
    }
    if (!job.quiet && outcome.kept > 0) {
        cli::print_out(missing.empty()
                           ? fmt::format("kept     all {} pictures: nothing to render\n", outcome.kept)
                           : fmt::format("kept     {} pictures, {} to render\n", outcome.kept, missing.size()));
    }

    int failed_in_a_row = 0;
    cli::ProgressPrinter printer(job.quiet);
    job::BatchProgress progress(total, printer.callback());
    for (const SweepPicture* picture : missing) {
        const job::RenderedPicture rendered = job::render_picture(
            picture->scene, picture->window, integrate::Tracer::fast,
            {.threads = job.threads, .on_progress = progress.next(rays_of(*picture)), .cancel = &cancel});
        outcome.cancelled = rendered.result.cancelled || cancel.requested();
        if (!rendered.result.cancelled) {
            const std::filesystem::path path = job.folder / picture->file;
            const bool written = cli::is_written(path, [&] {
                image::write_picture(
                    path, rendered.picture, picture->metadata,
                    {.exr_format = image::ExrFormat::floating, .frames_per_second = image::frame_rate(picture->scene)});
            });
            failed_in_a_row = written ? 0 : failed_in_a_row + 1;
            outcome.unresolved_rays += rendered.result.counters.unresolved_rays;
            ++(written ? outcome.rendered : outcome.failed);
            if (written) {
                ledger[picture->file] = cost_of(rendered.result, picture->metadata);
                write_costs(files, job, ledger);
            }
        }
        if (outcome.cancelled || failed_in_a_row == kMostFailures) break;
    }
    printer.clear();
    return outcome;
}

}  // namespace strata::tools::sweep
