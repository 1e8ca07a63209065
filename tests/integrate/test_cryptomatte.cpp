// Ids of a Cryptomatte against published values, and pairs in their order.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "src/integrate/channels.h"
#include "src/integrate/cryptomatte.h"

using namespace strata::integrate;

TEST_CASE("the hash has the published values of MurmurHash3_x86_32 for tails of every length") {
    struct Known {
        const char* text;
        std::uint32_t hash;
    };
    for (const Known& known :
         {Known{"", 0u}, Known{"a", 0x3c2569b2u}, Known{"ab", 0x9bbfd75fu}, Known{"abc", 0xb3dd93fau},
          Known{"test", 0xba6bd213u}, Known{"Hello, world!", 0xc0363e43u},
          Known{"The quick brown fox jumps over the lazy dog", 0x2e4ff723u}}) {
        CAPTURE(known.text);
        CHECK(murmur_hash(known.text) == known.hash);
    }
}

TEST_CASE("ids are those of the test vectors that Cryptomatte's authors publish") {
    CHECK(crypto_id("hello") == 6.0705627102400005616e-17f);
    CHECK(crypto_id("cube") == -4.08461912519e+15f);
    CHECK(crypto_id("sphere") == 2.79018604383e+15f);
    CHECK(crypto_id("plane") == 3.66557617593e-11f);
    CHECK(crypto_id("m\xc3\xa4"
                    "dchen") == 6.2361298211599995797e+25f);
    // The bytes of Bulgarian "plane" have their highest bits set.
    CHECK(crypto_id("\xd1\x80\xd0\xb0\xd0\xb2\xd0\xbd\xd0\xb8\xd0\xbd\xd0\xb0") == -1.3192631212399999468e-25f);
}

TEST_CASE("ids are normal numbers, and differ from the hash where that is none and there by one exponent") {
    int moved = 0;
    for (int i = 0; i < 5000; ++i) {
        const std::string name = "layer" + std::to_string(i);
        const std::uint32_t hash = murmur_hash(name), id = std::bit_cast<std::uint32_t>(crypto_id(name));
        const std::uint32_t exponent = hash >> 23 & 255;
        CHECK(std::isnormal(crypto_id(name)));
        if (exponent != 0 && exponent != 255) {
            CHECK(id == hash);
            continue;
        }
        ++moved;
        CHECK((id >> 23 & 255) == (exponent == 0 ? 1 : 254));
        CHECK((id & ~(255u << 23)) == (hash & ~(255u << 23)));
    }
    CHECK(moved > 10);
}

TEST_CASE("pairs come in the order of what they cover, equal ones in that of names, and the rest is 0") {
    const std::array<float, 5> ids{1.0f, 2.0f, 3.0f, 4.0f, 5.0f};
    std::array<float, crypto_values(5)> pixel{0.125f, 0.0f, 0.5f, 0.125f, 0.25f, 7.0f};
    rank_coverages(ids, pixel);
    const std::array<float, crypto_values(5)> expected{3.0f, 0.5f, 5.0f, 0.25f, 1.0f, 0.125f, 4.0f, 0.125f};
    CHECK(pixel == expected);
}

TEST_CASE("channels come in fours, the last of an odd number half empty, and the header's key is the name's hash") {
    CHECK(crypto_channels("crypto_ground", 1) ==
          std::vector<std::string>{"crypto_ground00.r", "crypto_ground00.g", "crypto_ground00.b", "crypto_ground00.a"});
    CHECK(crypto_channels("crypto_ground", 3).size() == 8);
    CHECK(crypto_channels("crypto_ground", 3)[7] == "crypto_ground01.a");
    CHECK(crypto_channels("crypto_ground", 0).empty());
    // The key that other programs have for this name.
    const std::array<std::string, 2> names{"hello", "cube"};
    const auto header = crypto_header("crypto_object", names);
    CHECK(header[0] == std::pair<std::string, std::string>("cryptomatte/f834d0a/name", "crypto_object"));
    CHECK(header[3].second == R"({"hello":"248bfa47","cube":"d9682f08"})");
}
