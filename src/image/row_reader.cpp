#include "src/image/row_reader.h"

#include "src/image/image_error.h"
#include "src/image/library.h"
#include "src/image/library_noise.h"
#include "src/image/openimageio.h"

namespace strata::image {

struct RowReader::State {
    std::filesystem::path path;
    std::unique_ptr<OIIO::ImageInput> input;
    std::vector<std::string> extra;
    int next_row = 0;  // from the top
};

RowReader::RowReader(const std::filesystem::path& path) : state_(std::make_unique<State>()) {
    state_->path = path;
    configure_library();
    const LibraryNoise noise;
    state_->input = OIIO::ImageInput::create("openexr");
    OIIO::ImageSpec spec;
    if (!state_->input || !state_->input->open(path.string(), spec)) {
        fail_to_read(path, noise.explain(state_->input ? state_->input->geterror() : OIIO::geterror()));
    }
    const std::vector<std::string>& names = spec.channelnames;
    if (names.size() < 3 || names[0] != "R" || names[1] != "G" || names[2] != "B") {
        fail_to_read(path, "its first channels are not R, G and B");
    }
    state_->extra.assign(names.begin() + 3, names.end());
}

RowReader::~RowReader() = default;
RowReader::RowReader(RowReader&&) noexcept = default;

int RowReader::width() const { return state_->input->spec().width; }
int RowReader::height() const { return state_->input->spec().height; }
const std::vector<std::string>& RowReader::extra() const { return state_->extra; }

void RowReader::read(int rows, std::vector<float>& values) {
    const OIIO::ImageSpec& spec = state_->input->spec();
    const int first = spec.y + state_->next_row, last = first + rows;
    values.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(spec.width) *
                  static_cast<std::size_t>(spec.nchannels));
    const LibraryNoise noise;
    const bool is_read = spec.tile_width > 0
                             ? state_->input->read_tiles(0, 0, spec.x, spec.x + spec.width, first, last, 0, 1, 0,
                                                         spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())
                             : state_->input->read_scanlines(0, 0, first, last, 0, 0, spec.nchannels,
                                                             OIIO::TypeDesc::FLOAT, values.data());
    if (!is_read) fail_to_read(state_->path, noise.explain(state_->input->geterror()));
    state_->next_row += rows;
}

}  // namespace strata::image
