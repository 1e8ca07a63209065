// Pictures into the bytes of a file, strip by strip. Private to src/image.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "src/image/encode.h"
#include "src/image/format.h"
#include "src/image/openimageio.h"

namespace strata::image {

// Rows are written in order from the top, kStripRows at a time, the last ones fewer. Whatever the pixels hold, all rows
// must be written and finish() called: libjpeg ends the process when an encoder is abandoned.
class Encoder {
  public:
    // Throws ImageError for all that is known to be wrong without the pixels. `bytes` outlives the encoder.
    Encoder(const std::filesystem::path& path, const PictureShape& shape, const Metadata& metadata,
            const WriteOptions& options, OIIO::Filesystem::IOProxy& bytes);

    int rows_left() const { return shape_.height() - next_row_; }

    // Linear radiance; where it is not finite finish() will throw.
    void write_linear(std::span<const float> rgb, std::span<const float> extra = {}, const CodesHook& on_codes = {});

    // sRGB codes in [0,1].
    void write_codes(std::span<const float> rgb);

    // The rows of a picture that an encoder for the same path, shape and options has written, as they are.
    void copy(OIIO::ImageInput& written);

    // Black ones.
    void write_rows_left();

    // Throws ImageError that names the first pixel that is not finite, if any is. What has come of it is a whole file
    // but for its digest (digest.h), which its owner puts in.
    void finish();

    // Of radiance beyond the largest half: "3 pixels beyond 65504 ..."; empty if there was none.
    std::string clipping() const;

  private:
    void write(OIIO::TypeDesc type, const void* values, int rows);
    int rows_of(std::size_t values) const;
    std::size_t channels() const { return static_cast<std::size_t>(output_->spec().nchannels); }
    template <class Code>
    void write_coded(std::vector<Code> codes, OIIO::TypeDesc type, int rows, const CodesHook& on_codes);
    std::vector<std::size_t> places_in(const OIIO::ImageSpec& from) const;
    void write_exr(std::span<const float> rgb, std::span<const float> extra, int rows);
    void count_not_finite(std::span<const float> rgb);
    void count_clipped(std::span<const float> rgb);
    std::string describe(std::span<const float> rgb, std::size_t i) const;

    std::filesystem::path path_;
    Format format_;
    PictureShape shape_;
    WriteOptions options_;
    std::unique_ptr<OIIO::Filesystem::IOProxy> with_text_;  // of a PNG, where it is needed; outlives its output
    std::unique_ptr<OIIO::ImageOutput> output_;
    int next_row_ = 0;  // from the crop's top
    std::size_t not_finite_ = 0;
    std::string first_not_finite_;
    std::size_t clipped_ = 0;
    std::string first_clipped_;
};

// To whoever wants to be warned, of a file that is whole.
void tell_clipping(const std::filesystem::path& path, const Encoder& encoder, const WriteOptions& options);

}  // namespace strata::image
