#include "tools/picture_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <new>

#include "src/image/stream_target.h"
#include "tools/standard_output.h"

namespace strata::tools {

namespace {

namespace fs = std::filesystem;

image::PictureShape shape_of(const Job& job) {
    const scene::Film& frame = job.loaded.scene.film;
    const render::Window& w = job.window;
    return {frame.width, frame.height, w.x0, w.y0, w.x1, w.y1};
}

}  // namespace

PictureOutputs::PictureOutputs(const Job& job, const image::Metadata& metadata) : job_(job) {
    for (const Aov aov : job.aovs) costs_.emplace_back(aov, job.window);
    for (const fs::path& path : job.outputs) {
        outputs_.push_back({path, image::PictureStream(path, shape_of(job), metadata, job.write)});
    }
}

// Of each file that is left: a failure ends that file alone.
template <class Action>
void PictureOutputs::for_each(const Action& action) {
    for (Output& output : outputs_) {
        if (!output.stream) continue;
        try {
            action(output);
            continue;
        } catch (const std::bad_alloc&) {
            print_error(fmt::format("out of memory while writing \"{}\"", output.path.string()));
        } catch (const std::exception& error) {
            print_error(error.what());
        }
        output.stream.reset();
    }
}

void PictureOutputs::write_rows(std::span<const glm::vec3> pixels, std::span<const float> extra) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    const std::span<const float> rgb(&pixels[0].x, 3 * pixels.size());
    for_each([&](Output& output) { output.stream->write(rgb, extra); });
}

void PictureOutputs::write(const render::Film& strip) {
    write_rows(strip.pixels(), aov_values(job_.aovs, strip));
    for (CostPicture& picture : costs_) picture.add(strip);
}

void PictureOutputs::write_whole(const render::Film& film) {
    const std::span<const glm::vec3> pixels(film.pixels());
    const auto strip = static_cast<std::size_t>(film.window().width()) * image::kStripRows;
    for (std::size_t begin = 0; begin < pixels.size(); begin += strip) {
        write_rows(pixels.subspan(begin, std::min(strip, pixels.size() - begin)), {});
    }
}

bool PictureOutputs::any() const {
    return std::ranges::any_of(outputs_, [](const Output& output) { return output.stream.has_value(); });
}

bool PictureOutputs::all() const {
    return std::ranges::all_of(outputs_, [](const Output& output) { return output.stream.has_value(); });
}

bool PictureOutputs::write_costs(bool is_partial, const image::Metadata& metadata) {
    bool all_written = true;
    for (const CostPicture& picture : costs_) {
        const fs::path path = aov_path(job_, picture.aov());
        const fs::path target = is_partial ? partial_path(path) : path;
        try {
            image::write_canvas(target, picture.draw(job_.loaded.scene.title), metadata);
            tell_written(target);
        } catch (const std::exception& error) {
            print_error(error.what());
            all_written = false;
        }
    }
    return all_written;
}

void PictureOutputs::tell_written(const fs::path& path) const {
    if (!job_.quiet) print_out(fmt::format("wrote    {}\n", path.string()));
}

bool PictureOutputs::finish() {
    for_each([&](Output& output) {
        output.stream->finish();
        tell_written(output.path);
    });
    return write_costs(false, job_.metadata) && all();
}

bool PictureOutputs::finish_partial(const image::Metadata& metadata) {
    for_each([&](Output& output) {
        // Whoever reads a stream could not tell a part from the whole.
        if (image::stream_target(output.path)) return;
        const fs::path target = partial_path(output.path);
        output.stream->finish_partial(target, metadata);
        tell_written(target);
    });
    return write_costs(true, metadata) && all();
}

}  // namespace strata::tools
