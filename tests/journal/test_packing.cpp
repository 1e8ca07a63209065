#include <doctest/doctest.h>

#include <random>

#include "src/journal/journal_error.h"
#include "src/journal/packing.h"
#include "src/journal/pixel_record.h"
#include "tests/journal/journal_bytes.h"

using namespace strata::journal;
using strata::film::Rect;

TEST_CASE("packed samples come back, of every size and number of components") {
    std::mt19937_64 random(6);
    for (const std::uint32_t bytes : {1u, 2u, 4u, 8u}) {
        for (const std::uint32_t components : {1u, 2u, 3u, 7u}) {
            for (const std::size_t pixels : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{1000}}) {
                const SampleLayout layout{components, bytes};
                const Block samples = random_block(random, pixels * layout.pixel_bytes());
                CHECK(unpack(pack(samples, layout), layout, pixels) == samples);
            }
        }
    }
}

TEST_CASE("what pack() did not make is refused") {
    std::mt19937_64 random(7);
    const SampleLayout layout{3, 2};
    const Block samples = random_block(random, 600);
    const std::vector<unsigned char> packed = pack(samples, layout);
    CHECK_THROWS_AS(unpack(packed, layout, 99), JournalError);
    CHECK_THROWS_AS(unpack(packed, layout, 101), JournalError);
    CHECK_THROWS_AS(unpack(Bytes(packed).first(packed.size() / 2), layout, 100), JournalError);
    CHECK_THROWS_AS(unpack(packed, {3, 5}, 100), JournalError);
    for (int i = 0; i < 2000; ++i) {
        const Block noise = random_block(random, random() % 300);
        CHECK_THROWS_AS(unpack(noise, layout, 100), JournalError);
    }
}

TEST_CASE("smooth samples become small") {
    Block samples;
    for (int i = 0; i < 10000; ++i) {
        for (const int value : {i, 3 * i, 30000 - i}) {
            samples.push_back(static_cast<unsigned char>(value));
            samples.push_back(static_cast<unsigned char>(value >> 8));
        }
    }
    CHECK(pack(samples, {3, 2}).size() < samples.size() / 50);
}

TEST_CASE("a record of pixels tells its rectangles and gives its parts back") {
    std::mt19937_64 random(8);
    const PixelHead head{42, {{-3, 2, 5, 4}, {10, 10, 11, 20}}};
    CHECK(head.pixels() == 26);
    const std::vector<PixelPart> parts{{{3, 2}, random_block(random, 26 * 6)}, {{2, 4}, random_block(random, 26 * 8)}};
    const std::vector<unsigned char> record = pixel_record(head, parts);
    PayloadReader reader(record);
    const PixelHead found = read_pixel_head(reader);
    CHECK(found.film == 42);
    CHECK(found.rects == head.rects);
    const std::vector<PixelPart> back = read_pixel_parts(reader, found);
    REQUIRE(back.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(back[i].layout == parts[i].layout);
        CHECK(back[i].samples == parts[i].samples);
    }
    CHECK(reader.is_empty());
    PayloadReader start(Bytes(record).first(pixel_head_bytes(Bytes(record).first(kPixelHeadStart))));
    CHECK(read_pixel_head(start).rects == head.rects);
}

TEST_CASE("a record of pixels that is cut or altered throws, or gives rectangles that are not empty") {
    std::mt19937_64 random(9);
    const PixelPart part{{3, 2}, random_block(random, 16 * 6)};
    const std::vector<unsigned char> record = pixel_record({1, {{0, 0, 4, 4}}}, {&part, 1});
    const auto read = [](Bytes bytes) {
        PayloadReader reader(bytes);
        const PixelHead head = read_pixel_head(reader);
        for (const Rect& rect : head.rects) CHECK((rect.width() > 0 && rect.height() > 0));
        read_pixel_parts(reader, head);
    };
    for (std::size_t size = 0; size < record.size(); ++size) {
        CHECK_THROWS_AS(read(Bytes(record).first(size)), JournalError);
    }
    int thrown = 0;
    for (std::size_t at = 0; at < record.size(); ++at) {
        for (const int value : {0, 1, 0x7f, 0x80, 0xff}) {
            std::vector<unsigned char> altered = record;
            altered[at] = static_cast<unsigned char>(value);
            try {
                read(altered);
            } catch (const JournalError&) {
                ++thrown;
            }
        }
    }
    CHECK(thrown > 50);
}
