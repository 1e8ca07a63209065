// A picture that goes into its file while it is made, and is never held whole.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "src/image/encode.h"
#include "src/image/output_file.h"

namespace strata::image {

// The file appears by finish() or finish_partial(), with the very bytes that write_picture() gives; until then, or if
// neither is reached, there is only a hidden file beside it (output_file.h). JPEG is the exception: it is encoded in
// memory. All throw ImageError, as encode() and replace_file() do; an error of the disk is told by the next call, and
// a picture that is not finite by finish().
class PictureStream {
  public:
    PictureStream(const std::filesystem::path& path, const PictureShape& shape, const Metadata& metadata,
                  const WriteOptions& options);
    // Into a file that was begun before.
    PictureStream(std::unique_ptr<OutputFile> file, const PictureShape& shape, const Metadata& metadata,
                  const WriteOptions& options);
    ~PictureStream();
    PictureStream(PictureStream&&) noexcept;
    PictureStream& operator=(PictureStream&&) noexcept;

    // The next kStripRows rows, or those that are left: linear radiance, three floats a pixel; and for an EXR as many
    // values a pixel as WriteOptions::exr_extra names, which other formats leave out.
    void write(std::span<const float> rgb, std::span<const float> extra = {}, const CodesHook& on_codes = {});

    // After the last row.
    void finish();

    // Rows not yet written are black. What is there gets other metadata and goes to another path of the same extension;
    // pixels stay as they were written, but for JPEG's, which are encoded once more. Where that path cannot be written,
    // what there is is kept as OutputFile::keep() does.
    void finish_partial(const std::filesystem::path& path, const Metadata& metadata);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strata::image
