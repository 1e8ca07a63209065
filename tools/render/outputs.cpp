#include "tools/render/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "src/image/format.h"
#include "src/image/stream_target.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::render {

namespace fs = std::filesystem;

PictureOutputs::PictureOutputs(const Job& job) : job_(job) {
    for (const fs::path& path : job.outputs) {
        outputs_.push_back({path, std::nullopt, std::make_unique<image::OutputFile>(path), std::nullopt});
        note_hidden(*outputs_.back().file);
    }
    for (const LayerFile& file : job.layer_files) {
        outputs_.push_back({file.path, file.layer, std::make_unique<image::OutputFile>(file.path), std::nullopt});
        note_hidden(*outputs_.back().file);
    }
    if (job.shard) return;  // pictures of AOVs are of the whole
    for (const integrate::ChannelSet::Entry& aov : job.aovs.entries()) {
        if (job::is_drawn(*aov.channel)) note_hidden(costs_.emplace_back(job, aov).file);
    }
}

void PictureOutputs::note_hidden(const image::OutputFile& file) {
    if (const auto path = file.scratch_path()) hidden_files_.push_back(*path);
}

void PictureOutputs::begin(Output& output, const image::Metadata& metadata) {
    if (!output.layer) {
        output.stream.emplace(std::move(output.file), job_.shape(), metadata, job_.write);
        return;
    }
    image::Metadata of_layer = metadata;
    of_layer.set("strata:layer", output.layer->channel->name);
    image::WriteOptions options = job_.write;
    options.exr_format = image::ExrFormat::floating;
    output.stream.emplace(std::move(output.file), job_.shape(), of_layer, options);
}

void PictureOutputs::begin(const image::Metadata& metadata) {
    for (Output& output : outputs_) begin(output, metadata);
}

void PictureOutputs::begin_late(const image::Metadata& metadata) {
    for (Output& output : outputs_) cli::is_written(output.path, [&] { begin(output, metadata); });
}

// Of each file that is left: a failure ends that file alone.
template <class Action>
void PictureOutputs::for_each(const Action& action) {
    for (Output& output : outputs_) {
        if (!output.stream) continue;
        if (!cli::is_written(output.path, [&] { action(output); })) output.stream.reset();
    }
}

void PictureOutputs::write_rows(std::span<const glm::vec3> pixels, std::span<const float> extra) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    const std::span<const float> rgb(&pixels[0].x, 3 * pixels.size());
    const std::span<const float> beside = job_.layer_files.empty() ? extra : std::span<const float>();
    for_each([&](Output& output) {
        if (output.layer) return output.stream->write(layer_pixels(*output.layer, extra, job_.aovs.values()));
        output.stream->write(rgb, beside,
                             journal_ != nullptr ? journal_->codes_hook(image::format_of(output.path)) : nullptr);
    });
}

void PictureOutputs::write(const film::Film& strip) {
    write_rows(strip.pixels(), strip.channels());
    for (Costs& costs : costs_) costs.picture.add(strip);
    if (journal_ != nullptr) journal_->written(strip);
}

void PictureOutputs::write_whole(const film::Film& film) {
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

bool PictureOutputs::write_costs() {
    bool all = true;
    for (Costs& costs : costs_) {
        const fs::path& path = costs.file.target();
        all &= cli::is_written(path, [&] {
            const image::Canvas canvas = costs.picture.draw(job_.picture.scene.title);
            costs.file.write_at(0, image::encode_canvas(path, canvas, job_.metadata));
            costs.file.put_in_place();
            tell_written(path);
        });
    }
    return all;
}

bool PictureOutputs::write_partial_costs(const image::Metadata& metadata) {
    bool all = true;
    for (const Costs& costs : costs_) {
        const fs::path path = partial_path(job_, costs.file.target());
        all &= cli::is_written(path, [&] {
            image::write_canvas(path, costs.picture.draw(job_.picture.scene.title), metadata);
            tell_written(path);
        });
    }
    return all;
}

void PictureOutputs::tell_written(const fs::path& path) const {
    if (!job_.quiet) cli::print_out(fmt::format("wrote    {}\n", path.string()));
}

bool PictureOutputs::finish() {
    for_each([&](Output& output) {
        output.stream->finish();
        tell_written(output.path);
    });
    return write_costs() && all();
}

bool PictureOutputs::finish_partial(const image::Metadata& metadata) {
    for_each([&](Output& output) {
        // Whoever reads a stream could not tell a part from the whole.
        if (image::stream_target(output.path)) return;
        const fs::path target = partial_path(job_, output.path);
        output.stream->finish_partial(target, metadata);
        tell_written(target);
    });
    return write_partial_costs(metadata) && all();
}

}  // namespace strata::tools::render
