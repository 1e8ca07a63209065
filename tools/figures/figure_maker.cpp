#include "tools/figures/figure_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "src/image/picture_metadata.h"
#include "src/image/write.h"
#include "src/scene/validate.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/standard_output.h"
#include "tools/figures/record.h"
#include "tools/job/render_picture.h"

namespace strata::tools::figures {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_of(const Plan& plan) {
    std::vector<std::string> files = plan.data;
    for (const Shown& shown : plan.shown) files.push_back(shown.file);
    for (const Part& part : plan.parts) files.push_back(part.file);
    return files;
}

// One meter for the renders of many figures.
class TotalProgress {
  public:
    TotalProgress(double total_work, bool quiet) : total_work_(total_work), printer_(quiet) {}

    parallel::ProgressCallback of_part(const Part& part) {
        return [this, work = part.work(), show = printer_.callback()](const parallel::Progress& progress) {
            part_rays_ = progress.rays;
            show({.fraction = (done_work_ + work * progress.fraction) / total_work_,
                  .rays = done_rays_ + progress.rays,
                  .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count()});
        };
    }

    void finish(const Part& part, std::uint64_t rays) {
        done_work_ += part.work();
        done_rays_ += rays;
    }

    void clear() { printer_.clear(); }

  private:
    double total_work_;
    cli::ProgressPrinter printer_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double done_work_ = 0;
    std::uint64_t done_rays_ = 0, part_rays_ = 0;
};

class Maker {
  public:
    Maker(const MakeOptions& options, const parallel::CancelToken& cancel, double total_work)
        : options_(options), cancel_(cancel), progress_(total_work, options.quiet) {}

    void make(const Figure& figure, const Plan& plan) {
        // Without its record a figure counts as unfinished, so that an interruption leaves none that is half new.
        empty_record(record_path(options_.folder, plan.number));
        std::vector<image::Picture> pictures;
        for (const Part& part : plan.parts) pictures.push_back(render_part(part));
        stop_if_cancelled();
        figure.draw(plan, pictures, options_.folder);
        write_record(record_path(options_.folder, plan.number), record_of(plan, options_.size), files_of(plan));
        tell("made", plan);
    }

    void keep(const Plan& plan) { tell("kept", plan); }

  private:
    void stop_if_cancelled() const {
        if (cancel_.requested()) throw Interrupted();
    }

    image::Picture render_part(const Part& part) {
        stop_if_cancelled();
        job::RenderedPicture rendered = job::render_picture(
            part.scene, part.window, integrate::Tracer::fast,
            {.threads = options_.threads, .on_progress = progress_.of_part(part), .cancel = &cancel_});
        if (rendered.result.cancelled) throw Interrupted();
        progress_.finish(part, rendered.result.counters.rays);
        image::write_picture(
            options_.folder / part.file, rendered.picture,
            image::picture_metadata(part.scene, part.window, "fast", "float"),
            {.exr_format = image::ExrFormat::floating, .frames_per_second = image::frame_rate(part.scene)});
        return std::move(rendered.picture);
    }

    void tell(const char* what, const Plan& plan) {
        progress_.clear();
        if (options_.quiet) return;
        cli::print_out(fmt::format("{}     {}\n", what, (options_.folder / plan.shown.front().file).string()));
        cli::flush_out();
    }

    const MakeOptions& options_;
    const parallel::CancelToken& cancel_;
    TotalProgress progress_;
};

double work_of(const Plan& plan) {
    double work = 0;
    for (const Part& part : plan.parts) work += part.work();
    return work;
}

}  // namespace

fs::path record_path(const fs::path& folder, int number) { return folder / fmt::format("figure-{}.json", number); }

std::vector<fs::path> paths_of(const Figure& figure, const MakeOptions& options) {
    std::vector<fs::path> paths{record_path(options.folder, figure.number)};
    for (const std::string& file : files_of(figure.plan(options.size))) paths.push_back(options.folder / file);
    return paths;
}

bool is_made(const MakeOptions& options, const Plan& plan) {
    return is_made(record_path(options.folder, plan.number), record_of(plan, options.size), files_of(plan),
                   options.quiet);
}

bool make_figures(const std::vector<Figure>& figures, const MakeOptions& options, const parallel::CancelToken& cancel) {
    std::vector<Plan> plans;
    std::vector<bool> kept;
    double work = 0;
    for (const Figure& figure : figures) {
        plans.push_back(figure.plan(options.size));
        for (const Part& part : plans.back().parts) scene::validate(part.scene, part.file);
        // Plots take no time.
        kept.push_back(!options.overwrite && !figure.is_plot && is_made(options, plans.back()));
        if (!kept.back()) work += work_of(plans.back());
    }
    bool all = true;
    Maker maker(options, cancel, std::max(work, 1.0));
    for (std::size_t i = 0; i < figures.size(); ++i) {
        if (cancel.requested()) throw Interrupted();
        if (kept[i])
            maker.keep(plans[i]);
        else
            all &= cli::is_written(record_path(options.folder, plans[i].number),
                                   [&] { maker.make(figures[i], plans[i]); });
    }
    return all;
}

}  // namespace strata::tools::figures
