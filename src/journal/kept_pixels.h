// Which pixels of a film are in a journal, and in which records.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "src/film/film.h"
#include "src/film/row_stream.h"
#include "src/journal/file.h"

namespace strata::journal {

// Memory: a bit a pixel for each strip of which some pixels are there and others are not.
class KeptPixels {
  public:
    explicit KeptPixels(const film::StripLayout& layout);

    // A record that holds these rectangles. False, and nothing of it counts, where one of them lies outside the window
    // or in two strips.
    bool add(const RecordPlace& place, std::span<const film::Rect> rects);

    // Whether all pixels of a rectangle within a strip are there.
    bool has(const film::Rect& rect) const;

    // In the order in which they were added.
    std::span<const RecordPlace> records_of(int strip) const {
        return strips_[static_cast<std::size_t>(strip)].records;
    }

    std::int64_t pixels() const { return pixels_; }
    const film::StripLayout& layout() const { return layout_; }

  private:
    struct Strip {
        std::vector<RecordPlace> records;
        std::vector<bool> there;  // row by row; empty while none or all are
        std::int64_t count = 0;   // of pixels that are there
    };

    std::int64_t area(int strip) const;
    void mark(int number, const film::Rect& rect);

    film::StripLayout layout_;
    std::vector<Strip> strips_;
    std::int64_t pixels_ = 0;
};

}  // namespace strata::journal
