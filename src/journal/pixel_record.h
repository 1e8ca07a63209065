// A record of finished pixels: rectangles of a picture and all that is kept of their pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/film/film.h"
#include "src/journal/packing.h"
#include "src/journal/payload.h"

namespace strata::journal {

// Samples of one kind - halves of an EXR, codes of a PNG, floats - of all pixels of a record: rectangle by rectangle,
// each row by row.
struct PixelPart {
    SampleLayout layout;
    std::vector<unsigned char> samples;
};

struct PixelHead {
    std::uint32_t film = 0;  // the number of a pass, where several films are kept
    std::vector<film::Rect> rects;

    std::size_t pixels() const;
};

// Packs the parts, all of which have the head's pixels.
std::vector<unsigned char> pixel_record(const PixelHead& head, std::span<const PixelPart> parts);

// How many bytes of a record its head takes, told by the first kPixelHeadStart of them.
inline constexpr std::size_t kPixelHeadStart = 8;
std::size_t pixel_head_bytes(Bytes start);

// Both throw JournalError for what no pixel_record() gave. A rectangle is not empty.
PixelHead read_pixel_head(PayloadReader& payload);
std::vector<PixelPart> read_pixel_parts(PayloadReader& payload, const PixelHead& head);

// Rows of a rectangle between a film and a record: calls copy(index of the row's first pixel in a film of this window,
// index in the record, pixels).
template <class Copy>
void for_each_row(const film::Rect& window, std::span<const film::Rect> rects, const Copy& copy) {
    std::size_t in_record = 0;
    for (const film::Rect& rect : rects) {
        const auto width = static_cast<std::size_t>(rect.width());
        for (int y = rect.y0; y < rect.y1; ++y, in_record += width) {
            const auto row = static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width());
            copy(row + static_cast<std::size_t>(rect.x0 - window.x0), in_record, width);
        }
    }
}

}  // namespace strata::journal
