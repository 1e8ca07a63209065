#include <doctest/doctest.h>

#include "tests/journal/journal_bytes.h"

using namespace strata::journal;

// The bytes are made as they are read: heads, and zeros for a payload that no memory holds.
TEST_CASE("a record of more than 4 GB is checked as a whole, and one behind it is found") {
    constexpr std::uint64_t kLength = (std::uint64_t{9} << 29) + 5;
    const Block zeros(1 << 20, 0);
    std::vector<Bytes> parts;
    for (std::uint64_t done = 0; done < kLength; done += zeros.size()) {
        parts.push_back(Bytes(zeros).first(std::min<std::uint64_t>(zeros.size(), kLength - done)));
    }
    const auto file = file_head(kTestId);
    const auto large = record_head({7, kLength, checksum(kTestId, parts)}, kTestId);
    const Block last{1, 2, 3};
    const Bytes last_part(last);
    const auto head = record_head({8, last.size(), checksum(kTestId, {&last_part, 1})}, kTestId);
    Block front(file.begin(), file.end()), back(head.begin(), head.end());
    front.insert(front.end(), large.begin(), large.end());
    back.insert(back.end(), last.begin(), last.end());
    const std::uint64_t back_at = front.size() + kLength;
    int flipped = 0;
    const ReadAt read = [&](std::int64_t offset, std::span<unsigned char> into) {
        for (std::size_t i = 0; i < into.size();) {
            const std::uint64_t at = static_cast<std::uint64_t>(offset) + i;
            if (at >= front.size() && at + into.size() - i <= back_at) {
                std::fill(into.begin() + static_cast<std::ptrdiff_t>(i), into.end(), static_cast<unsigned char>(0));
                if (flipped != 0 && at <= back_at - 1 && back_at - 1 < at + into.size() - i) into.back() = 1;
                return into.size();
            }
            if (at >= back_at + back.size()) return i;
            into[i++] = at < front.size() ? front[at] : at < back_at ? 0 : back[at - back_at];
        }
        return into.size();
    };
    const auto size = static_cast<std::int64_t>(back_at + back.size());
    const std::optional<Scan> found = scan(read, size);
    REQUIRE(found);
    REQUIRE(found->places.size() == 2);
    CHECK(found->places[0].length == kLength);
    CHECK(found->places[1].offset == static_cast<std::int64_t>(back_at + kRecordHeadBytes));
    CHECK(found->end == size);
    flipped = 1;
    const std::optional<Scan> damaged = scan(read, size);
    REQUIRE(damaged);
    REQUIRE(damaged->places.size() == 1);
    CHECK(damaged->places[0].type == 8);
}
