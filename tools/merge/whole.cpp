#include "tools/merge/whole.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "src/image/encode.h"
#include "src/image/image_error.h"
#include "src/image/picture_metadata.h"
#include "src/image/picture_stream.h"
#include "src/image/row_reader.h"
#include "tools/cli/errors.h"
#include "tools/cli/scene_argument.h"
#include "tools/job/aov.h"

namespace strata::tools::merge {

namespace {

namespace fs = std::filesystem;

static_assert(film::kShardBlock == image::kStripRows, "blocks of a row of the whole are a strip of its file");

// The slots of a part, one after the other, by rows of them.
class PartRows {
  public:
    PartRows(const Part& part, const film::Rect& whole) : picture_(whole, part.shard), reader_(part.path) {
        const film::Rect window = picture_.window();
        if (reader_.width() == window.width() && reader_.height() == window.height()) return;
        throw cli::UsageError(fmt::format("{}: {}x{} pixels are no part {}/{} of this picture", part.path.string(),
                                          reader_.width(), reader_.height(), part.shard.number, part.shard.count));
    }

    const std::vector<std::string>& extra() const { return reader_.extra(); }

    // Calls put(row of the block, its values) for the rows of the next slot, which is that of `block`.
    template <class Put>
    void next(const film::Rect& block, const Put& put) {
        const std::int64_t in_row = next_ % picture_.slots_a_row();
        if (in_row == 0) reader_.read(film::kShardBlock, values_);
        if (picture_.block(next_) != block) throw std::logic_error("parts are not in the order of the whole");
        ++next_;
        const std::size_t channels = 3 + reader_.extra().size();
        const auto row = static_cast<std::size_t>(reader_.width()) * channels;
        for (int y = 0; y < block.height(); ++y) {
            const std::size_t first =
                static_cast<std::size_t>(y) * row + static_cast<std::size_t>(in_row) * film::kShardBlock * channels;
            put(y, std::span(values_).subspan(first, static_cast<std::size_t>(block.width()) * channels));
        }
    }

  private:
    film::ShardPicture picture_;
    image::RowReader reader_;
    std::int64_t next_ = 0;
    std::vector<float> values_;
};

// A strip of the whole's rows.
struct Strip {
    std::vector<float> rgb, extra;

    void resize(const film::Rect& rows, std::size_t extra_channels) {
        const auto pixels = static_cast<std::size_t>(rows.width()) * static_cast<std::size_t>(rows.height());
        rgb.resize(3 * pixels);
        extra.resize(extra_channels * pixels);
    }

    // Values of pixels from the strip's pixel `at` on.
    void put(std::size_t at, std::span<const float> values, std::size_t extra_channels) {
        const std::size_t channels = 3 + extra_channels;
        for (std::size_t i = 0; i < values.size() / channels; ++i) {
            const float* pixel = &values[i * channels];
            std::copy_n(pixel, 3, &rgb[3 * (at + i)]);
            if (extra_channels > 0) std::copy_n(pixel + 3, extra_channels, &extra[extra_channels * (at + i)]);
        }
    }
};

// As a render of the whole sets them.
image::WriteOptions write_options(const Parts& parts, const cli::LoadedScene& loaded,
                                  const std::vector<std::string>& extra,
                                  const std::function<void(const std::string&)>& warn) {
    return {.colour = image::colour_out(loaded.scene.film),
            .exr_format =
                parts.metadata.find("strata:format") == "float" ? image::ExrFormat::floating : image::ExrFormat::half,
            .exr_layout = loaded.is_tiled ? image::ExrLayout::tiles : image::ExrLayout::automatic,
            .exr_extra = extra,
            .exr_attributes = job::aov_header(job::aovs_of("", loaded, 1), loaded.layer_prefix.value_or("")),
            .frames_per_second = image::frame_rate(loaded.scene),
            .warn = warn};
}

}  // namespace

void write_whole(const Parts& parts, const fs::path& output, const std::function<void(double)>& tell,
                 const std::function<void(const std::string&)>& warn) {
    const cli::LoadedScene loaded = cli::SceneArgument(parts.first.string()).load();
    const film::Rect window = cli::window_of("", loaded);
    const film::ShardDeal deal(window, static_cast<int>(parts.parts.size()));
    if (static_cast<std::int64_t>(parts.parts.size()) > deal.blocks()) {
        throw cli::UsageError(fmt::format("{}: a picture of {} blocks has not {} parts", parts.first.string(),
                                          deal.blocks(), parts.parts.size()));
    }
    std::vector<PartRows> rows;
    for (const Part& part : parts.parts) rows.emplace_back(part, window);
    const std::vector<std::string> extra = rows.front().extra();
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (rows[i].extra() == extra) continue;
        throw cli::UsageError(
            fmt::format("{}: other channels than {}", parts.parts[i].path.string(), parts.first.string()));
    }
    const scene::Film& frame = loaded.scene.film;
    const image::PictureShape shape{frame.width, frame.height, window.x0, window.y0, window.x1, window.y1};
    image::PictureStream stream(output, shape, parts.metadata, write_options(parts, loaded, extra, warn));
    Strip strip;
    std::vector<int> owners;
    for (std::int64_t index = 0; index < deal.blocks(); ++index) {
        const std::int64_t in_deal = index % static_cast<std::int64_t>(rows.size());
        if (in_deal == 0) owners = deal.owners_of_deal(index / static_cast<std::int64_t>(rows.size()));
        const film::Rect block = deal.block(index);
        const film::Rect strip_rows{window.x0, block.y0, window.x1, block.y1};
        if (block.x0 == window.x0) strip.resize(strip_rows, extra.size());
        PartRows& part = rows[static_cast<std::size_t>(owners[static_cast<std::size_t>(in_deal)] - 1)];
        part.next(block, [&](int y, std::span<const float> values) {
            const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(window.width());
            strip.put(row + static_cast<std::size_t>(block.x0 - window.x0), values, extra.size());
        });
        if (block.x1 < window.x1) continue;
        stream.write(strip.rgb, strip.extra);
        tell(static_cast<double>(index + 1) / static_cast<double>(deal.blocks()));
    }
    stream.finish();
}

}  // namespace strata::tools::merge
