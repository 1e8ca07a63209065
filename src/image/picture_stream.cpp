#include "src/image/picture_stream.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <fstream>
#include <vector>

#include "src/image/digest.h"
#include "src/image/encoder.h"
#include "src/image/image_error.h"
#include "src/image/library_noise.h"
#include "src/image/output_file.h"

namespace strata::image {
namespace {

// Encoders do not stop well when they cannot write: they are told that they could, and flush_or_throw() tells. They
// write headers byte by byte, which are gathered here.
class FileProxy final : public OIIO::Filesystem::IOProxy {
  public:
    explicit FileProxy(const std::filesystem::path& target) : IOProxy(target.string(), Write), file_(target) {}

    const char* proxytype() const override { return "strata"; }
    std::size_t size() const override { return static_cast<std::size_t>(size_); }

    std::size_t write(const void* data, std::size_t count) override {
        pwrite(data, count, m_pos);
        m_pos += static_cast<std::int64_t>(count);
        return count;
    }

    std::size_t pwrite(const void* data, std::size_t count, std::int64_t offset) override {
        constexpr std::size_t kGathered = 1 << 16;
        if (offset != gathered_at_ + static_cast<std::int64_t>(gathered_.size()) || gathered_.size() >= kGathered) {
            write_gathered();
            gathered_at_ = offset;
        }
        const auto* bytes = static_cast<const unsigned char*>(data);
        gathered_.insert(gathered_.end(), bytes, bytes + count);
        size_ = std::max(size_, offset + static_cast<std::int64_t>(count));
        return count;
    }

    // Throws ImageError if anything could not be written.
    void flush_or_throw() {
        write_gathered();
        if (failure_) std::rethrow_exception(failure_);
    }

    OutputFile& file() { return file_; }

  private:
    void write_gathered() {
        try {
            if (!failure_) file_.write_at(gathered_at_, gathered_);
        } catch (...) {
            failure_ = std::current_exception();
        }
        gathered_.clear();
    }

    OutputFile file_;
    std::vector<unsigned char> gathered_;
    std::int64_t gathered_at_ = 0;
    std::int64_t size_ = 0;
    std::exception_ptr failure_;
};

}  // namespace

struct PictureStream::State {
    State(const std::filesystem::path& path, const PictureShape& picture_shape, const Metadata& metadata,
          const WriteOptions& write_options)
        : format(format_of(path)),
          shape(picture_shape),
          options(write_options),
          bytes(path),
          encoder(path, shape, metadata, options, bytes) {}

    Format format;
    PictureShape shape;
    WriteOptions options;
    FileProxy bytes;
    Encoder encoder;
    bool is_closed = false;

    void close() {
        is_closed = true;
        encoder.finish();
        bytes.flush_or_throw();
    }

    // The header went first, so the digest of all bytes takes reading them back.
    void put_in_place() {
        std::ifstream written(bytes.file().hidden_path(), std::ios::binary);
        const auto read = [&](std::int64_t offset, std::span<unsigned char> part) {
            written.clear();
            written.seekg(offset);
            written.read(reinterpret_cast<char*>(part.data()), static_cast<std::streamsize>(part.size()));
            return static_cast<std::size_t>(written.gcount());
        };
        put_digest(format, read, [&](std::int64_t offset, std::span<const unsigned char> part) {
            bytes.file().write_at(offset, part);
        });
        bytes.file().put_in_place();
    }
};

PictureStream::PictureStream(const std::filesystem::path& path, const PictureShape& shape, const Metadata& metadata,
                             const WriteOptions& options)
    : state_(std::make_unique<State>(path, shape, metadata, options)) {}

PictureStream::PictureStream(PictureStream&&) noexcept = default;
PictureStream& PictureStream::operator=(PictureStream&&) noexcept = default;

PictureStream::~PictureStream() {
    if (!state_ || state_->is_closed) return;
    try {
        state_->encoder.write_rows_left();
        state_->close();
    } catch (const std::exception&) {  // the file is given up anyway
    }
}

void PictureStream::write(std::span<const float> rgb, std::span<const float> extra) {
    state_->encoder.write_linear(rgb, extra);
    state_->bytes.flush_or_throw();
}

void PictureStream::finish() {
    state_->close();
    state_->put_in_place();
    tell_clipping(state_->bytes.filename(), state_->encoder, state_->options);
}

void PictureStream::finish_partial(const std::filesystem::path& path, const Metadata& metadata) {
    state_->encoder.write_rows_left();
    state_->close();
    const std::filesystem::path& written = state_->bytes.file().hidden_path();
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(name_of(format_of(path)));
    if (!input) throw ImageError(OIIO::geterror());
    OIIO::ImageSpec spec;
    {
        const LibraryNoise noise;
        if (!input->open(written.string(), spec)) throw ImageError(noise.explain(input->geterror()));
    }
    State partial(path, state_->shape, metadata, state_->options);
    try {
        partial.encoder.copy(*input);
    } catch (...) {
        partial.encoder.write_rows_left();
        partial.close();
        throw;
    }
    partial.close();
    partial.put_in_place();
    tell_clipping(path, state_->encoder, state_->options);
}

}  // namespace strata::image
