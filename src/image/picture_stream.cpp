#include "src/image/picture_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

#include "src/image/digest.h"
#include "src/image/encoder.h"
#include "src/image/image_error.h"
#include "src/image/library_noise.h"
#include "src/image/output_file.h"

namespace strata::image {

// Encoders do not stop well when they cannot write: they are told that they could, and flush_or_throw() tells. They
// write headers byte by byte, which are gathered here.
class FileProxy final : public OIIO::Filesystem::IOProxy {
  public:
    explicit FileProxy(std::unique_ptr<OutputFile> file)
        : IOProxy(file->target().string(), Write), file_(std::move(file)) {}

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

    OutputFile& file() { return *file_; }
    const OutputFile& file() const { return *file_; }

  private:
    void write_gathered() {
        try {
            if (!failure_) file_->write_at(gathered_at_, gathered_);
        } catch (...) {
            failure_ = std::current_exception();
        }
        gathered_.clear();
    }

    std::unique_ptr<OutputFile> file_;
    std::vector<unsigned char> gathered_;
    std::int64_t gathered_at_ = 0;
    std::int64_t size_ = 0;
    std::exception_ptr failure_;
};

struct PictureStream::State {
    State(std::unique_ptr<OutputFile> file, const PictureShape& picture_shape, const Metadata& metadata,
          const WriteOptions& write_options)
        : format(format_of(file->target())),
          shape(picture_shape),
          options(write_options),
          bytes(std::move(file)),
          encoder(bytes.file().target(), shape, metadata, options, bytes) {}

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
    void complete() {
        const auto read = [&](std::int64_t offset, std::span<unsigned char> part) {
            return bytes.file().read_at(offset, part);
        };
        put_digest(format, read, [&](std::int64_t offset, std::span<const unsigned char> part) {
            bytes.file().write_at(offset, part);
        });
    }

    // The rows of another one, of the same shape and options.
    void copy_from(const State& written) {
        try {
            const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(name_of(format));
            if (!input) throw ImageError(OIIO::geterror());
            OIIO::ImageSpec spec;
            {
                const LibraryNoise noise;
                const std::string path = written.bytes.file().hidden_path().string();
                if (!input->open(path, spec)) throw ImageError(noise.explain(input->geterror()));
            }
            encoder.copy(*input);
        } catch (...) {
            encoder.write_rows_left();
            close();
            throw;
        }
        close();
        complete();
    }
};

PictureStream::PictureStream(const std::filesystem::path& path, const PictureShape& shape, const Metadata& metadata,
                             const WriteOptions& options)
    : PictureStream(std::make_unique<OutputFile>(path), shape, metadata, options) {}

PictureStream::PictureStream(std::unique_ptr<OutputFile> file, const PictureShape& shape, const Metadata& metadata,
                             const WriteOptions& options)
    : state_(std::make_unique<State>(std::move(file), shape, metadata, options)) {}

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

void PictureStream::write(std::span<const float> rgb, std::span<const float> extra, const CodesHook& on_codes) {
    state_->encoder.write_linear(rgb, extra, on_codes);
    state_->bytes.flush_or_throw();
}

void PictureStream::finish() {
    state_->close();
    state_->complete();
    state_->bytes.file().put_in_place();
    tell_clipping(state_->bytes.file().target(), state_->encoder, state_->options);
}

void PictureStream::finish_partial(const std::filesystem::path& path, const Metadata& metadata) {
    state_->encoder.write_rows_left();
    state_->close();
    std::unique_ptr<State> partial;
    try {
        partial = std::make_unique<State>(std::make_unique<OutputFile>(path), state_->shape, metadata, state_->options);
        partial->copy_from(*state_);
    } catch (const std::exception& error) {
        state_->complete();
        state_->bytes.file().keep(fmt::format("unfinished, and {}", error.what()));
    }
    partial->bytes.file().put_in_place();
    tell_clipping(path, state_->encoder, state_->options);
}

}  // namespace strata::image
