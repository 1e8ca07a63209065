// What a crash can leave of a journal: it is cut, some of it never reached the disk, or bits are flipped. Whatever is
// read back was written.
#include <doctest/doctest.h>

#include "tests/journal/journal_bytes.h"

using namespace strata::journal;

namespace {

std::vector<Block> some_payloads(std::mt19937_64& random) {
    std::vector<Block> payloads;
    for (const std::size_t size : {5, 0, 1, 300, 24, 64}) payloads.push_back(random_block(random, size));
    return payloads;
}

// Ends of the records in the file, the first being that of the head.
std::vector<std::size_t> ends_of(const std::vector<Block>& payloads) {
    std::vector<std::size_t> ends{kFileHeadBytes};
    for (const Block& payload : payloads) ends.push_back(ends.back() + kRecordHeadBytes + payload.size());
    return ends;
}

// All payloads but those whose record, head included, the bytes [first,last) touch.
std::vector<Block> untouched(const std::vector<Block>& payloads, std::size_t first, std::size_t last) {
    const std::vector<std::size_t> ends = ends_of(payloads);
    std::vector<Block> left;
    for (std::size_t i = 0; i < payloads.size(); ++i) {
        if (last <= ends[i] || first >= ends[i + 1]) left.push_back(payloads[i]);
    }
    return left;
}

}  // namespace

TEST_CASE("a journal that is cut at any byte gives all records that are whole, and ends behind them") {
    std::mt19937_64 random(1);
    const std::vector<Block> payloads = some_payloads(random);
    const Block whole = journal_of(payloads);
    const std::vector<std::size_t> ends = ends_of(payloads);
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        const Block cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        const std::optional<Scan> found = scan_of(cut);
        REQUIRE(found.has_value() == (size >= kFileHeadBytes));
        if (!found) continue;
        const auto after = std::upper_bound(ends.begin(), ends.end(), size);
        const auto count = after - ends.begin() - 1;
        CHECK(payloads_in(cut, *found) == std::vector<Block>(payloads.begin(), payloads.begin() + count));
        CHECK(found->end == static_cast<std::int64_t>(ends[static_cast<std::size_t>(count)]));
    }
}

TEST_CASE("whatever bit is flipped, no record is read back otherwise than it was written") {
    std::mt19937_64 random(2);
    const std::vector<Block> payloads = some_payloads(random);
    const Block whole = journal_of(payloads);
    const std::vector<std::size_t> ends = ends_of(payloads);
    for (std::size_t at = kFileHeadBytes; at < whole.size(); ++at) {
        for (int bit = 0; bit < 8; ++bit) {
            Block damaged = whole;
            damaged[at] ^= static_cast<unsigned char>(1 << bit);
            const std::optional<Scan> found = scan_of(damaged);
            REQUIRE(found);
            const auto record =
                static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), at) - ends.begin()) - 1;
            const bool in_head = at < ends[record] + kRecordHeadBytes;
            // A wrong payload costs its record; a wrong head hides what comes behind it.
            const std::vector<Block> expected =
                in_head ? std::vector<Block>(payloads.begin(), payloads.begin() + static_cast<std::ptrdiff_t>(record))
                        : untouched(payloads, at, at + 1);
            CHECK(payloads_in(damaged, *found) == expected);
        }
    }
}

TEST_CASE("parts that never reached the disk and are zeros, or hold another journal's bytes, cost what they touch") {
    std::mt19937_64 random(3);
    std::vector<Block> payloads;
    for (int i = 0; i < 12; ++i) payloads.push_back(random_block(random, random() % 400));
    std::vector<Block> others;
    for (const Block& payload : payloads) others.push_back(random_block(random, payload.size()));
    const Block whole = journal_of(payloads), other = journal_of(others, kTestId + 1);
    std::size_t whole_records = 0;
    for (int i = 0; i < 2000; ++i) {
        const std::size_t first = kFileHeadBytes + random() % (whole.size() - kFileHeadBytes);
        const std::size_t last = std::min(whole.size(), first + 1 + random() % 600);
        for (const Block& source : {Block(whole.size(), 0), other}) {
            Block damaged = whole;
            std::copy(source.begin() + static_cast<std::ptrdiff_t>(first),
                      source.begin() + static_cast<std::ptrdiff_t>(last),
                      damaged.begin() + static_cast<std::ptrdiff_t>(first));
            const std::optional<Scan> found = scan_of(damaged);
            REQUIRE(found);
            whole_records += found->places.size();
            for (const Block& payload : payloads_in(damaged, *found)) {
                CHECK(std::ranges::find(payloads, payload) != payloads.end());
            }
            // What lies before the damage is there in full.
            const auto before = untouched(payloads, first, whole.size());
            CHECK(found->places.size() >= before.size());
        }
    }
    CHECK(whole_records > 2000);
}

TEST_CASE("random bytes are no journal, and no record") {
    std::mt19937_64 random(4);
    for (int i = 0; i < 20000; ++i) {
        Block bytes = random_block(random, random() % 200);
        CHECK(!scan_of(bytes));
        const auto head = file_head(kTestId);
        bytes.insert(bytes.begin(), head.begin(), head.end());
        const std::optional<Scan> found = scan_of(bytes);
        REQUIRE(found);
        CHECK(found->places.empty());
    }
}

TEST_CASE("a record that tells of more bytes than memory holds is read no further than the file") {
    Block bytes = journal_of({});
    for (const std::uint64_t length : {std::uint64_t{1}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
        Block damaged = bytes;
        const auto head = record_head({7, length, 0}, kTestId);
        damaged.insert(damaged.end(), head.begin(), head.end());
        const std::optional<Scan> found = scan_of(damaged);
        REQUIRE(found);
        CHECK(found->places.empty());
        CHECK(found->end == static_cast<std::int64_t>(kFileHeadBytes));
    }
}
