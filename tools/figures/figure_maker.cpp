#include "tools/figures/figure_maker.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "src/image/write.h"
#include "src/scene/validate.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/standard_output.h"
#include "tools/figures/record.h"
#include "tools/job/batch.h"

namespace strata::tools::figures {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_of(const Plan& plan) {
    std::vector<std::string> files = plan.data;
    for (const Shown& shown : plan.shown) files.push_back(shown.file);
    for (const Part& part : plan.parts) files.push_back(part.file);
    return files;
}

class Maker {
  public:
    Maker(const MakeOptions& options, const parallel::CancelToken& cancel)
        : options_(options), batch_(options.threads, options.quiet, cancel) {}

    void expect(const Plan& plan) {
        for (const Part& part : plan.parts) batch_.expect(part.job(), part.cost);
    }

    void make(const Figure& figure, const Plan& plan) {
        // Without its record a figure counts as unfinished, so that an interruption leaves none that is half new.
        empty_record(record_path(options_.folder, plan.number));
        std::vector<image::Picture> pictures;
        for (const Part& part : plan.parts) pictures.push_back(render_part(part));
        if (batch_.is_stopped()) throw Interrupted();
        figure.draw(plan, pictures, options_.folder);
        write_record(record_path(options_.folder, plan.number), record_of(plan, options_.size), files_of(plan));
        tell("made", plan);
    }

    void keep(const Plan& plan) { tell("kept", plan); }

  private:
    image::Picture render_part(const Part& part) {
        const job::PictureJob job = part.job();
        auto rendered = batch_.render(job, part.cost);
        if (!rendered) throw Interrupted();
        image::write_picture(options_.folder / part.file, rendered->picture, job.metadata("float"), job.float_exr());
        return std::move(rendered->picture);
    }

    void tell(const char* what, const Plan& plan) {
        batch_.clear_progress();
        if (options_.quiet) return;
        cli::print_out(fmt::format("{}     {}\n", what, (options_.folder / plan.shown.front().file).string()));
        cli::flush_out();
    }

    const MakeOptions& options_;
    job::Batch batch_;
};

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
    Maker maker(options, cancel);
    for (const Figure& figure : figures) {
        plans.push_back(figure.plan(options.size));
        for (const Part& part : plans.back().parts) scene::validate(part.scene, part.file);
        // Plots take no time.
        kept.push_back(!options.overwrite && !figure.is_plot && is_made(options, plans.back()));
        if (!kept.back()) maker.expect(plans.back());
    }
    bool all = true;
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
