#include "src/journal/packing.h"

#include <zstd.h>

#include <cstring>

#include "src/journal/journal_error.h"

namespace strata::journal {
namespace {

constexpr int kLevel = 1;

// Planes of bytes, those of one component behind those of the one before, low bytes first.
template <class Number>
void split(const unsigned char* samples, std::size_t pixels, std::size_t components, unsigned char* planes) {
    for (std::size_t c = 0; c < components; ++c) {
        Number before = 0;
        for (std::size_t i = 0; i < pixels; ++i) {
            Number value;
            std::memcpy(&value, samples + (i * components + c) * sizeof value, sizeof value);
            const auto difference = static_cast<Number>(value - before);
            before = value;
            for (std::size_t b = 0; b < sizeof value; ++b) {
                planes[(c * sizeof value + b) * pixels + i] = static_cast<unsigned char>(difference >> (8 * b));
            }
        }
    }
}

template <class Number>
void join(const unsigned char* planes, std::size_t pixels, std::size_t components, unsigned char* samples) {
    for (std::size_t c = 0; c < components; ++c) {
        Number value = 0;
        for (std::size_t i = 0; i < pixels; ++i) {
            Number difference = 0;
            for (std::size_t b = 0; b < sizeof value; ++b) {
                const Number byte = planes[(c * sizeof value + b) * pixels + i];
                difference = static_cast<Number>(difference | byte << (8 * b));
            }
            value = static_cast<Number>(value + difference);
            std::memcpy(samples + (i * components + c) * sizeof value, &value, sizeof value);
        }
    }
}

// Calls action with a number of that many bytes.
template <class Action>
void with_number(std::uint32_t bytes, const Action& action) {
    switch (bytes) {
        case 1:
            return action(std::uint8_t{});
        case 2:
            return action(std::uint16_t{});
        case 4:
            return action(std::uint32_t{});
        case 8:
            return action(std::uint64_t{});
        default:
            throw JournalError("a record of the journal holds numbers of an unknown size");
    }
}

}  // namespace

std::vector<unsigned char> pack(Bytes samples, const SampleLayout& layout) {
    const std::size_t pixels = samples.size() / layout.pixel_bytes();
    std::vector<unsigned char> planes(samples.size());
    with_number(layout.bytes,
                [&]<class Number>(Number) { split<Number>(samples.data(), pixels, layout.components, planes.data()); });
    std::vector<unsigned char> packed(ZSTD_compressBound(planes.size()));
    const std::size_t size = ZSTD_compress(packed.data(), packed.size(), planes.data(), planes.size(), kLevel);
    if (ZSTD_isError(size)) throw JournalError(ZSTD_getErrorName(size));
    packed.resize(size);
    return packed;
}

std::vector<unsigned char> unpack(Bytes packed, const SampleLayout& layout, std::size_t pixels) {
    const auto fail = [] { throw JournalError("a record of the journal does not hold the pixels that it tells of"); };
    // Before memory is asked for.
    if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != pixels * layout.pixel_bytes()) fail();
    std::vector<unsigned char> planes(pixels * layout.pixel_bytes());
    const std::size_t size = ZSTD_decompress(planes.data(), planes.size(), packed.data(), packed.size());
    if (ZSTD_isError(size) || size != planes.size()) fail();
    std::vector<unsigned char> samples(planes.size());
    with_number(layout.bytes,
                [&]<class Number>(Number) { join<Number>(planes.data(), pixels, layout.components, samples.data()); });
    return samples;
}

}  // namespace strata::journal
