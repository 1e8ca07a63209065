#include "tools/render/journal.h"

#include <fmt/format.h>

#include "src/image/file_paths.h"
#include "src/image/stream_target.h"
#include "tools/cli/standard_output.h"
#include "tools/job/program_id.h"

namespace strata::tools::render {
namespace fs = std::filesystem;
namespace {

std::vector<job::SampleKind> kinds_of(const Job& job) {
    return job::kept_kinds(job.outputs, job.write.exr_format, !job.aovs.empty());
}

std::string text_of(const std::vector<job::SampleKind>& kinds) {
    std::string text;
    for (const job::SampleKind kind : kinds) {
        const char* name = "";
        switch (kind) {
            case job::SampleKind::halves:
                name = "halves of an EXR";
                break;
            case job::SampleKind::floats:
                name = "floats of an EXR";
                break;
            case job::SampleKind::codes_8:
                name = "codes of PNG or JPEG";
                break;
            case job::SampleKind::codes_16:
                name = "codes of a TIFF";
                break;
            case job::SampleKind::channels:
                name = "AOVs";
                break;
        }
        text += fmt::format("{}{}", text.empty() ? "" : ", ", name);
    }
    return text;
}

}  // namespace

fs::path journal_path(const Job& job) {
    for (const fs::path& path : job.outputs) {
        if (image::stream_target(path)) continue;
        return image::derived_path(path, path.extension().string() + ".journal");
    }
    return {};
}

journal::Identity identity_of(const Job& job) {
    journal::Identity identity;
    identity.set("program", job::program_id());
    const strata::render::PassGoal& goal = job.goal;
    identity.set("passes", fmt::format("{}", goal.passes));
    identity.set("target-rmse", fmt::format("{}", goal.target_rmse));
    identity.set("time-limit", fmt::format("{} s", goal.time_limit_s));
    identity.set("outputs", goal.passes > 1 ? "sums of passes" : text_of(kinds_of(job)));
    for (const auto& [name, value] : job.metadata.entries()) {
        constexpr std::string_view kPrefix = "strata:";
        if (name == image::kSceneKey)
            identity.set_lines(value);
        else
            identity.set(name.substr(kPrefix.size()), value);
    }
    return identity;
}

RenderJournal::RenderJournal(const Job& job)
    : job_(job), work_(journal_path(job), identity_of(job), job.journal, job.quiet) {
    if (job.goal.passes > 1) {
        passes_.emplace(work_, job.rendered_window());
    } else {
        still_.emplace(work_, film::StripLayout{job.rendered_window(), image::kStripRows}, kinds_of(job),
                       job.write.colour);
    }
    if (!work_.is_resumed() || job.quiet) return;
    if (still_) {
        const film::Rect window = job.rendered_window();
        const double share = static_cast<double>(still_->kept_pixels()) / (1.0 * window.width() * window.height());
        cli::print_out(
            fmt::format("resumed  {:.1f} % of the pixels are in {}\n", 100 * share, journal_path(job).string()));
    } else {
        cli::print_out(fmt::format("resumed  from {}\n", journal_path(job).string()));
    }
}

void RenderJournal::end(bool is_whole) {
    if (is_whole) return work_.remove();
    if (still_) still_->finish();
    if (!job_.quiet) cli::print_out(work_.kept_line());
}

}  // namespace strata::tools::render
