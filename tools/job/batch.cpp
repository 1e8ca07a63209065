#include "tools/job/batch.h"

#include <fmt/format.h>

#include <utility>

#include "src/trace/ray.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::job {

Batch::Batch(int threads, bool quiet, const parallel::CancelToken& cancel)
    : threads_(threads), quiet_(quiet), cancel_(cancel), printer_(quiet), progress_(0, printer_.callback()) {}

std::optional<RenderedPicture> Batch::render(const PictureJob& job, double cost) {
    RenderedPicture rendered = render_picture(
        job, {.threads = threads_, .on_progress = progress_.next(cost * job.expected_rays()), .cancel = &cancel_});
    unresolved_rays_ += rendered.result.counters.unresolved_rays;
    if (!rendered.result.cancelled) return rendered;
    clear_progress();
    return std::nullopt;
}

void Batch::warn_of_unresolved() const { job::warn_of_unresolved(unresolved_rays_, quiet_); }

void warn_of_unresolved(std::uint64_t rays, bool quiet) {
    if (rays == 0 || quiet) return;
    cli::print_error(fmt::format("warning: {} {} not settled within {} steps; drawn in magenta, or as shadow", rays,
                                 rays == 1 ? "ray was" : "rays were", trace::kStepLimit));
}

}  // namespace strata::tools::job
