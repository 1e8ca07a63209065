#include "src/journal/pixel_record.h"

namespace strata::journal {
namespace {

// More than any picture has: a bound for what a damaged or foreign record asks memory for.
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 34;

[[noreturn]] void fail() { throw JournalError("a record of the journal tells of impossible pixels"); }

}  // namespace

std::size_t PixelHead::pixels() const {
    std::size_t count = 0;
    for (const film::Rect& rect : rects)
        count += static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
    return count;
}

std::vector<unsigned char> pixel_record(const PixelHead& head, std::span<const PixelPart> parts) {
    PayloadWriter payload;
    payload.put(head.film);
    payload.put<std::uint32_t>(static_cast<std::uint32_t>(head.rects.size()));
    for (const film::Rect& rect : head.rects) payload.put(rect);
    payload.put<std::uint32_t>(static_cast<std::uint32_t>(parts.size()));
    for (const PixelPart& part : parts) {
        const std::vector<unsigned char> packed = pack(part.samples, part.layout);
        payload.put(part.layout);
        payload.put<std::uint64_t>(packed.size());
        payload.put_bytes(packed);
    }
    return {payload.bytes().begin(), payload.bytes().end()};
}

std::size_t pixel_head_bytes(Bytes start) {
    PayloadReader reader(start);
    reader.take<std::uint32_t>();
    return kPixelHeadStart + sizeof(film::Rect) * std::size_t{reader.take<std::uint32_t>()};
}

PixelHead read_pixel_head(PayloadReader& payload) {
    PixelHead head{payload.take<std::uint32_t>(), {}};
    const auto count = payload.take<std::uint32_t>();
    std::uint64_t pixels = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto rect = payload.take<film::Rect>();
        // In 64 bits: the sides of a damaged rectangle need not fit an int.
        const std::int64_t width = std::int64_t{rect.x1} - rect.x0, height = std::int64_t{rect.y1} - rect.y0;
        if (width <= 0 || height <= 0 || width >= INT32_MAX || height >= INT32_MAX) fail();
        pixels += static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
        if (pixels > kMostPixels) fail();
        head.rects.push_back(rect);
    }
    return head;
}

std::vector<PixelPart> read_pixel_parts(PayloadReader& payload, const PixelHead& head) {
    constexpr std::uint32_t kMostParts = 16, kMostComponents = 1024;
    const std::size_t pixels = head.pixels();
    const auto count = payload.take<std::uint32_t>();
    if (count > kMostParts) fail();
    std::vector<PixelPart> parts;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto layout = payload.take<SampleLayout>();
        if (layout.components == 0 || layout.components > kMostComponents) fail();
        const Bytes packed = payload.take_bytes(payload.take<std::uint64_t>());
        parts.push_back({layout, unpack(packed, layout, pixels)});
    }
    return parts;
}

PixelRecord read_pixel_record(Bytes payload) {
    PayloadReader reader(payload);
    PixelRecord record{read_pixel_head(reader), {}};
    record.parts = read_pixel_parts(reader, record.head);
    return record;
}

}  // namespace strata::journal
