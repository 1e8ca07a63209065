#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "src/image/encode.h"
#include "src/image/picture_stream.h"
#include "src/image/samples.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

// Of all exponents, among them what is no normal half, ties between halves, and the largest.
std::vector<float> awkward_values(std::size_t count) {
    std::mt19937_64 random(12);
    std::vector<float> values{0.0f,    -0.0f, kMaxHalf, -kMaxHalf, 65503.9f,          6e-8f,
                              2.9e-8f, 3e-8f, 1e-30f,   1.0f,      1.0f + 1.0f / 2048};
    while (values.size() < count) {
        const auto bits = static_cast<std::uint32_t>(random());
        float value;
        std::memcpy(&value, &bits, sizeof value);
        if (std::fabs(value) <= kMaxHalf) values.push_back(value);
        values.push_back(
            std::ldexp(static_cast<float>(random() % 4096 + 2048) / 2048, static_cast<int>(random() % 40) - 26));
    }
    values.resize(count);
    return values;
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("an EXR of the halves that a picture's values become is that of the picture") {
    Picture picture = make_picture(120, 128);
    picture.rgb = awkward_values(picture.rgb.size());
    const std::vector<unsigned char> expected = encode("a.exr", picture, {}, {});
    const std::vector<std::uint16_t> kept = halves(picture.rgb);
    picture.rgb = floats(kept);
    CHECK(encode("a.exr", picture, {}, {}) == expected);
    CHECK(halves(picture.rgb) == kept);
}

TEST_CASE("whoever is given the codes sees what the file holds, and may put others in their place") {
    const ScratchFolder folder;
    const PictureShape shape{70, 100, 0, 0, 70, 100};
    std::mt19937 random(13);
    std::vector<float> rgb(3 * 70 * 100);
    for (float& value : rgb) value = std::uniform_real_distribution<float>(0, 1.2f)(random);
    for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
        std::vector<std::vector<unsigned char>> kept;
        const auto write = [&](const std::filesystem::path& path, bool black, const CodesHook& hook) {
            PictureStream stream(path, shape, {}, {});
            for (int y = 0; y < 100; y += kStripRows) {
                std::vector<float> rows(rgb.begin() + 3 * 70 * y, rgb.begin() + 3 * 70 * std::min(100, y + kStripRows));
                if (black) std::fill(rows.begin(), rows.end(), 0.0f);
                stream.write(rows, {}, hook);
            }
            stream.finish();
            return bytes_of(path);
        };
        const std::string expected = write(folder / name, false, {});
        CHECK(write(folder / name, false, [&](std::span<unsigned char> codes) {
                  kept.emplace_back(codes.begin(), codes.end());
              }) == expected);
        REQUIRE(kept.size() == 2);
        std::size_t next = 0;
        CHECK(write(folder / name, true, [&](std::span<unsigned char> codes) {
                  REQUIRE(codes.size() == kept[next].size());
                  std::copy(kept[next].begin(), kept[next].end(), codes.begin());
                  ++next;
              }) == expected);
    }
}

TEST_CASE("codes of a part of a picture are those of the whole there") {
    std::mt19937 random(14);
    std::vector<float> rgb(3 * 40 * 30);
    for (float& value : rgb) value = std::uniform_real_distribution<float>(0, 1)(random);
    const ColourOut colour;
    const std::vector<std::uint8_t> whole = codes_of_8_bits(rgb, colour, 5, 7, 40);
    const std::vector<std::uint8_t> row =
        codes_of_8_bits(std::span(rgb).subspan(3 * (40 * 11 + 8), 3 * 9), colour, 5 + 8, 7 + 11, 9);
    CHECK(std::equal(row.begin(), row.end(), whole.begin() + 3 * (40 * 11 + 8)));
}
