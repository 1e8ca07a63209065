#include "tools/animate/make.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <optional>
#include <system_error>

#include "src/image/image_error.h"
#include "src/image/not_finite.h"
#include "src/image/picture_metadata.h"
#include "src/image/write.h"
#include "tools/animate/film.h"
#include "tools/animate/frames_folder.h"
#include "tools/animate/sheet.h"
#include "tools/cli/endings.h"
#include "tools/cli/errors.h"
#include "tools/cli/standard_output.h"
#include "tools/job/already_there.h"
#include "tools/job/batch.h"

namespace strata::tools::animate {

namespace {

namespace fs = std::filesystem;

// A frame that is not there yet, and which of its files are to be written.
struct Todo {
    int frame = 0;
    std::vector<fs::path> missing;
};

// Throws UsageError for the first file that is there and is not the frame asked for.
Todo files_to_write(const Job& job, int frame) {
    const image::Metadata metadata = frame_metadata(job, frame);
    Todo todo{frame, {}};
    for (const FrameOutput& output : job.frames) {
        fs::path path = output.pattern.path(frame);
        const auto other = output.is_scratch ? job::IfOther::replace : job::IfOther::refuse;
        const bool is_replaced = job.overwrite && !output.is_scratch;
        if (is_replaced || !job::is_kept(path, metadata, frame_shape(job), other, job.quiet)) {
            todo.missing.push_back(std::move(path));
        }
    }
    return todo;
}

class Frames {
  public:
    Frames(const Job& job, const parallel::CancelToken& cancel) : job_(job), batch_(job.threads, job.quiet, cancel) {
        for (const int frame : job_.range) {
            Todo todo = files_to_write(job_, frame);
            if (todo.missing.empty()) continue;
            for (const job::PictureJob& picture : frame_pictures(job_, frame)) batch_.expect(picture);
            work_.push_back(std::move(todo));
        }
    }

    // False when it was stopped.
    bool make() {
        for (const Todo& todo : work_) {
            if (!make_frame(todo)) return false;
            if (batch_.is_failing()) break;
        }
        batch_.clear_progress();
        return !batch_.is_stopped() || batch_.is_failing();
    }

    int kept() const { return job_.range.count() - static_cast<int>(work_.size()); }
    int rendered() const { return rendered_; }

    // Whether all that a film is made of is there.
    bool has_film_source() const { return has_film_source_; }
    const job::Batch& batch() const { return batch_; }

  private:
    bool make_frame(const Todo& todo) {
        std::vector<image::Picture> pictures;
        const std::vector<job::PictureJob> jobs = frame_pictures(job_, todo.frame);
        for (const job::PictureJob& job : jobs) {
            auto rendered = batch_.render(job);
            if (!rendered) return false;
            pictures.push_back(std::move(rendered->picture));
        }
        const image::Metadata metadata = frame_metadata(job_, todo.frame);
        if (job_.columns.empty()) {
            image::WriteOptions options = job_.write;
            options.frames_per_second = image::frame_rate(jobs.front().scene);
            write(todo, [&](const fs::path& path) { image::write_picture(path, pictures.front(), metadata, options); });
        } else {
            const image::Canvas sheet = sheet_of(todo.frame, jobs, pictures);
            write(todo, [&](const fs::path& path) { image::write_canvas(path, sheet, metadata); });
        }
        return true;
    }

    image::Canvas sheet_of(int frame, const std::vector<job::PictureJob>& jobs,
                           const std::vector<image::Picture>& pictures) const {
        std::vector<image::Canvas> canvases;
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            const std::string not_finite = image::describe_not_finite(pictures[i]);
            if (!not_finite.empty()) {
                throw image::ImageError(fmt::format("frame {}, picture {}: {}", frame, i + 1, not_finite));
            }
            canvases.push_back(image::to_canvas(pictures[i], image::colour_out(jobs[i].scene.film)));
        }
        return side_by_side(job_.columns, std::move(canvases));
    }

    template <class Write>
    void write(const Todo& todo, const Write& write_file) {
        const fs::path source =
            job_.films.empty() ? fs::path() : job_.frames[job_.film_source].pattern.path(todo.frame);
        bool is_source_lost = std::ranges::find(todo.missing, source) != todo.missing.end();
        rendered_ += batch_.write(todo.missing, [&](const fs::path& path) {
            write_file(path);
            if (path == source) is_source_lost = false;
        });
        has_film_source_ &= !is_source_lost && !batch_.is_failing();
    }

    const Job& job_;
    job::Batch batch_;
    std::vector<Todo> work_;
    int rendered_ = 0;
    bool has_film_source_ = true;
};

// Their folder goes by itself.
void remove_scratch_frames(const Job& job) {
    std::error_code ignored;
    const FrameOutput& source = job.frames[job.film_source];
    if (!source.is_scratch) return;
    for (const int frame : job.range) fs::remove(source.pattern.path(frame), ignored);
}

struct FilmOutput {
    explicit FilmOutput(const fs::path& film) : path(film), file(film) {}

    fs::path path;
    image::ScratchFile file;
};

// Each fails alone. False if one did.
bool make_films(const Job& job, std::list<FilmOutput>& films, const parallel::CancelToken& cancel) {
    bool all = true;
    for (FilmOutput& film : films) {
        const FilmTiming timing = film_timing(film.path, job.range, job.scene.shutter.fps);
        try {
            encode_film(film.path, film.file, job.frames[job.film_source].pattern, timing, job.width, job.height);
            if (!cancel.requested()) film.file.place();
        } catch (const std::exception& error) {
            // The signal that stopped this program stopped ffmpeg too.
            if (cancel.requested()) return false;
            cli::print_error(cli::message_of(error));
            all = false;
            continue;
        }
        if (cancel.requested()) return false;
        if (!job.quiet)
            cli::print_out(fmt::format("wrote    {} ({})\n", film.path.string(), described(timing, job.range)));
    }
    return all;
}

void say_what_was_done(const Job& job, const Frames& frames) {
    frames.batch().warn_of_unresolved();
    if (job.quiet) return;
    cli::print_out(fmt::format("frames   {} rendered, {} kept\n", frames.rendered(), frames.kept()));
    for (const FrameOutput& output : job.frames) {
        if (output.is_scratch || !frames.batch().all_written()) continue;
        cli::print_out(fmt::format("wrote    {}\n", output.pattern.text()));
    }
}

}  // namespace

int make_animation(Job job, const parallel::CancelToken& cancel) {
    std::list<FilmOutput> films;
    for (const fs::path& film : job.films) films.emplace_back(film);
    std::optional<FramesFolder> folder;
    if (has_scratch_frames(job)) add_scratch_frames(job, folder.emplace(job.films.front()).path());
    Frames frames(job, cancel);
    if (!frames.make()) {
        if (!job.quiet) {
            cli::print_out(
                fmt::format("stopped  after {} of {} frames, which are kept; the same command goes on from there\n",
                            frames.rendered() + frames.kept(), job.range.count()));
        }
        return cli::exit_code_of(true);
    }
    say_what_was_done(job, frames);
    bool all_written = frames.batch().all_written();
    if (frames.has_film_source() && !films.empty()) {
        const bool all_made = make_films(job, films, cancel);
        if (cancel.requested()) return cli::exit_code_of(true);
        if (all_made) remove_scratch_frames(job);
        all_written &= all_made;
    } else if (!films.empty()) {
        cli::print_error("no film was made: some of its frames could not be written");
    }
    return all_written ? 0 : cli::kExitRuntime;
}

}  // namespace strata::tools::animate
