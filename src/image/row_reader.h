// An EXR read from the top, some rows at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "src/image/picture.h"

namespace strata::image {

// Of a picture that strata wrote: R, G, B and perhaps more channels. All throw ImageError, which names the file.
class RowReader {
  public:
    explicit RowReader(const std::filesystem::path& path);
    ~RowReader();
    RowReader(RowReader&&) noexcept;

    int width() const;
    int height() const;

    // Names of the channels beside R, G and B, in the file's order.
    const std::vector<std::string>& extra() const;

    // The next `rows` rows (whole tiles of an EXR in tiles): R, G, B and then the others, pixel by pixel.
    void read(int rows, std::vector<float>& values);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strata::image
