#include <fmt/format.h>

#include <list>
#include <memory>
#include <optional>
#include <system_error>

#include "src/image/image_error.h"
#include "src/image/not_finite.h"
#include "src/image/picture_metadata.h"
#include "src/image/write.h"
#include "src/parallel/cancel.h"
#include "tools/animate/film.h"
#include "tools/animate/frames_folder.h"
#include "tools/animate/job.h"
#include "tools/animate/sheet.h"
#include "tools/cli/command_line.h"
#include "tools/cli/endings.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/standard_output.h"
#include "tools/job/already_there.h"
#include "tools/job/batch_progress.h"
#include "tools/job/render_picture.h"

namespace strata::tools::animate {

namespace {

namespace fs = std::filesystem;

constexpr int kMostFailures = 2;

// A frame that is not there yet, and which of its files are to be written.
struct Todo {
    int frame = 0;
    std::vector<fs::path> missing;
};

// Throws UsageError for the first file that is there and is not the frame asked for.
Todo files_to_write(const AnimateJob& job, int frame) {
    const image::Metadata metadata = frame_metadata(job, frame);
    const image::PictureShape whole{job.width, job.height, 0, 0, job.width, job.height};
    Todo todo{frame, {}};
    for (const FrameOutput& output : job.frames) {
        const fs::path path = output.pattern.path(frame);
        const bool replaces = job.overwrite && !output.is_scratch;
        const job::Found found = replaces ? job::Found{} : job::find_picture(path, metadata, whole);
        if (found.presence == job::Presence::same) continue;
        if (found.presence == job::Presence::damaged && !job.quiet) job::tell_damaged(path, found);
        if (found.presence == job::Presence::other && !output.is_scratch) {
            throw cli::UsageError(
                fmt::format("{} is there and is not the frame asked for: {}; allowed: --overwrite, or "
                            "another -o",
                            path.string(), found.why));
        }
        todo.missing.push_back(path);
    }
    return todo;
}

class Animator {
  public:
    Animator(const AnimateJob& job, const parallel::CancelToken& cancel)
        : job_(job),
          cancel_(cancel),
          printer_(job.quiet),
          work_(find_work()),
          progress_(total(), printer_.callback()) {}

    int kept() const { return job_.range.count() - static_cast<int>(work_.size()); }
    int rendered() const { return rendered_; }
    std::uint64_t unresolved() const { return unresolved_; }

    // Of files that could not be written, as was told.
    bool all_written() const { return all_written_; }
    bool has_film_source() const { return has_film_source_; }

    // False when it was stopped. Ends early where no file of two frames in a row can be written.
    bool run() {
        for (const Todo& todo : work_) {
            if (!render_frame(todo)) return false;
            if (failed_in_a_row_ == kMostFailures) return true;
        }
        return !cancel_.requested();
    }

  private:
    std::vector<Todo> find_work() const {
        std::vector<Todo> work;
        for (const int frame : job_.range) {
            Todo todo = files_to_write(job_, frame);
            if (!todo.missing.empty()) work.push_back(std::move(todo));
        }
        return work;
    }

    static film::Rect window(const scene::Scene& scene) { return {0, 0, scene.film.width, scene.film.height}; }

    double total() const {
        double a_frame = 0;
        for (const scene::Scene& scene : frame_scenes(job_, job_.range.first())) {
            a_frame += job::expected_rays(scene, window(scene));
        }
        return a_frame * static_cast<double>(work_.size());
    }

    bool render_frame(const Todo& todo) {
        std::vector<image::Picture> pictures;
        const std::vector<scene::Scene> scenes = frame_scenes(job_, todo.frame);
        for (const scene::Scene& scene : scenes) {
            const double weight = job::expected_rays(scene, window(scene));
            job::RenderedPicture rendered = job::render_picture(
                scene, window(scene), cli::parse_tracer(job_.tracer),
                {.threads = job_.threads, .on_progress = progress_.next(weight), .cancel = &cancel_});
            if (rendered.result.cancelled) {
                printer_.clear();
                return false;
            }
            unresolved_ += rendered.result.counters.unresolved_rays;
            pictures.push_back(std::move(rendered.picture));
        }
        write(todo, scenes, pictures);
        return true;
    }

    void write(const Todo& todo, const std::vector<scene::Scene>& scenes, const std::vector<image::Picture>& pictures) {
        const image::Metadata metadata = frame_metadata(job_, todo.frame);
        if (job_.columns.empty()) {
            image::WriteOptions options = job_.write;
            options.frames_per_second = image::frame_rate(scenes.front());
            write_each(todo,
                       [&](const fs::path& path) { image::write_picture(path, pictures.front(), metadata, options); });
            return;
        }
        std::vector<image::Canvas> canvases;
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            const std::string not_finite = image::describe_not_finite(pictures[i]);
            if (!not_finite.empty()) {
                throw image::ImageError(fmt::format("frame {}, picture {}: {}", todo.frame, i + 1, not_finite));
            }
            canvases.push_back(image::to_canvas(pictures[i], image::colour_out(scenes[i].film)));
        }
        const image::Canvas sheet = side_by_side(job_.columns, std::move(canvases));
        write_each(todo, [&](const fs::path& path) { image::write_canvas(path, sheet, metadata); });
    }

    template <class Write>
    void write_each(const Todo& todo, const Write& write) {
        bool any_written = false;
        for (const fs::path& path : todo.missing) {
            const bool written = cli::is_written(path, [&] { write(path); });
            any_written |= written;
            all_written_ &= written;
            const bool is_source =
                !job_.films.empty() && path == job_.frames[job_.film_source].pattern.path(todo.frame);
            has_film_source_ &= written || !is_source;
        }
        if (any_written) ++rendered_;
        failed_in_a_row_ = any_written ? 0 : failed_in_a_row_ + 1;
        has_film_source_ &= failed_in_a_row_ < kMostFailures;
    }

    const AnimateJob& job_;
    const parallel::CancelToken& cancel_;
    cli::ProgressPrinter printer_;
    std::vector<Todo> work_;
    job::BatchProgress progress_;
    int rendered_ = 0;
    std::uint64_t unresolved_ = 0;
    int failed_in_a_row_ = 0;
    bool all_written_ = true, has_film_source_ = true;
};

// Their folder goes by itself.
void remove_scratch_frames(const AnimateJob& job) {
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
bool make_films(const AnimateJob& job, std::list<FilmOutput>& films, const parallel::CancelToken& cancel) {
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

void say_what_was_done(const AnimateJob& job, const Animator& animator) {
    if (job.quiet) return;
    if (animator.unresolved() > 0) {
        cli::print_error(
            fmt::format("warning: {} rays were not settled within {} steps; drawn in magenta, or as shadow",
                        animator.unresolved(), trace::kStepLimit));
    }
    cli::print_out(fmt::format("frames   {} rendered, {} kept\n", animator.rendered(), animator.kept()));
    for (const FrameOutput& output : job.frames) {
        if (output.is_scratch || !animator.all_written()) continue;
        cli::print_out(fmt::format("wrote    {}\n", output.pattern.text()));
    }
}

int stopped(const AnimateJob& job, const Animator& animator) {
    if (!job.quiet) {
        cli::print_out(
            fmt::format("stopped  after {} of {} frames, which are kept; the same command goes on from there\n",
                        animator.rendered() + animator.kept(), job.range.count()));
    }
    return cli::kExitSignal + parallel::cancelling_signal();
}

int animate_command(const AnimateRequest& request) {
    static parallel::CancelToken cancel;
    parallel::cancel_on_signals(cancel);
    AnimateJob job = prepare_animation(request);
    std::list<FilmOutput> films;
    for (const fs::path& film : job.films) films.emplace_back(film);
    std::optional<FramesFolder> folder;
    if (has_scratch_frames(job)) add_scratch_frames(job, folder.emplace(job.films.front()).path());
    Animator animator(job, cancel);
    if (!animator.run()) return stopped(job, animator);
    say_what_was_done(job, animator);
    bool all_written = animator.all_written();
    if (animator.has_film_source() && !films.empty()) {
        const bool all_made = make_films(job, films, cancel);
        if (cancel.requested()) return cli::kExitSignal + parallel::cancelling_signal();
        if (all_made) remove_scratch_frames(job);
        all_written &= all_made;
    } else if (!films.empty()) {
        cli::print_error("no film was made: some of its frames could not be written");
    }
    return all_written ? 0 : cli::kExitRuntime;
}

void add_column_options(cli::Command& command, AnimateRequest& request) {
    command
        .add_option("--columns", request.columns,
                    "Pictures side by side, their settings between ';', as \"none; N=4 m=4; shutter.open_s=0.02 l=4 "
                    "label='blurred'\"; \"scene\" is the scene as it is")
        ->type_name("SETTINGS");
    command.add_option("--left", request.left, "The left one of two pictures: \"none\" (the default), \"N=4 m=4\" ...")
        ->type_name("SETTINGS");
    command.add_option("--right", request.right, "The right one; default the scene as it is")->type_name("SETTINGS");
}

}  // namespace

void add_command(cli::Command& program, int& exit_code) {
    cli::Command* command = program.add_subcommand("animate", "Render numbered frames and films");
    auto request = std::make_shared<AnimateRequest>();
    request->scene.add_to(*command);
    command
        ->add_option(
            "--frames", request->frames,
            "Frames first-last, both included, 0-100x2 for every second one, lists such as 0,2,7-9; default one "
            "loop of a spin or wheel, or to the last camera key")
        ->type_name("A-BxS,...");
    command
        ->add_option("-o,--output", request->outputs,
                     "NAME.png, .exr, .tif or .jpg: frames NAME.0001.png ... ('#'s choose where the number goes); "
                     "NAME.mp4, .webm or .gif: a film by ffmpeg (may be repeated); default SCENE.mp4")
        ->type_name("FILE")
        ->repeated();
    add_column_options(*command, *request);
    command->add_flag("--overwrite", request->overwrite, "Render and replace frames that are there");
    command->add_option("--threads", request->threads, "Threads, up to 1024; 0: as many as machine and container give")
        ->type_name("n")
        ->capture_default_str();
    command->add_option("--tracer", request->tracer, "fast, or reference")->type_name("NAME")->capture_default_str();
    command->add_option("--simd", request->simd, "avx512, avx2, sse4 or scalar; default the best that is here")
        ->type_name("TARGET");
    command->add_option("--format", request->format, "EXR channels: half (up to 65504) or float; default half")
        ->type_name("NAME");
    command->add_flag("--quiet", request->quiet, "No progress, summary or warnings");
    command->footer(
        "Frame k begins at k / shutter.fps seconds. What moves: camera.keys, surface.spin_deg_per_s, surface.drift, "
        "the\n"
        "wheel. Motion blur: shutter.open_s > 0, by a B-spline of order --time-order, N * N samples in all.\n"
        "A frame that is there, whole and of the same settings, is kept; an empty, cut or damaged one is made again. "
        "One\n"
        "of other settings is refused before anything is rendered, unless --overwrite is given. Films alone keep their "
        "frames in FILE.frames until they "
        "are\n"
        "encoded (of two runs at once one has FILE-2.frames); interrupted, the same command goes on from them.\n"
        "A film of every second frame (--frames 0-100x2) shows half as many a second. A GIF shows up to 50 a second "
        "and\n"
        "leaves out the others; it plays as long as the frames take, to a hundredth of a second.\n"
        "The built-in scenes isosurface and wheel are compared side by side unless --columns says otherwise.\n"
        "  strata animate isosurface                           loops: no antialiasing | in space and time\n"
        "  strata animate planet --frames 0-99 -o 'out/planet.####.exr' -o planet.mp4 --set shutter.open_s=0.02\n"
        "  strata animate wheel --columns \"none; l=1; l=4\" --size 320x320 -o wheel.gif\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.");
    command->callback([request, command, &exit_code] {
        if (command->count("--frame") > 0)
            throw cli::UsageError("--frame: allowed: --frames A-B, or --frames A for one");
        exit_code = animate_command(*request);
    });
}

}  // namespace strata::tools::animate
