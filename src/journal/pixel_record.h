// A record of finished pixels: rectangles of a picture and all that is kept of their pixels.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
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

struct PixelRecord {
    PixelHead head;
    std::vector<PixelPart> parts;
};

// How many bytes of a record its head takes, told by the first kPixelHeadStart of them.
inline constexpr std::size_t kPixelHeadStart = 8;
std::size_t pixel_head_bytes(Bytes start);

// All throw JournalError for what no pixel_record() gave. A rectangle is not empty.
PixelHead read_pixel_head(PayloadReader& payload);
std::vector<PixelPart> read_pixel_parts(PayloadReader& payload, const PixelHead& head);
PixelRecord read_pixel_record(Bytes payload);

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

// Calls set(x, y, index in the record) for each pixel of a record.
template <class Set>
void for_each_pixel(std::span<const film::Rect> rects, const Set& set) {
    std::size_t in_record = 0;
    for (const film::Rect& rect : rects) {
        for (int y = rect.y0; y < rect.y1; ++y) {
            for (int x = rect.x0; x < rect.x1; ++x) set(x, y, in_record++);
        }
    }
}

// What the array of a film of this window, with so many values a pixel, has of some pixels.
template <class T>
std::vector<T> gather(std::span<const T> values, std::size_t of_pixel, const film::Rect& window,
                      std::span<const film::Rect> rects) {
    std::vector<T> gathered;
    for_each_row(window, rects, [&](std::size_t first, std::size_t, std::size_t pixels) {
        const auto row = values.subspan(first * of_pixel, pixels * of_pixel);
        gathered.insert(gathered.end(), row.begin(), row.end());
    });
    return gathered;
}

template <class T>
PixelPart part_of(const SampleLayout& layout, const std::vector<T>& values) {
    static_assert(std::is_standard_layout_v<T>);  // vectors are arrays of their components
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    return {layout, std::vector<unsigned char>(bytes, bytes + values.size() * sizeof(T))};
}

}  // namespace strata::journal
