#include "src/image/dither.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "src/image/canvas.h"
#include "src/image/read.h"
#include "src/image/srgb.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

Picture picture_of(int width, int height, const auto& light) {
    Picture picture = make_picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) picture.rgb[3 * (y * width + x) + c] = static_cast<float>(light(x, y, c));
    return picture;
}

std::vector<int> codes_of(const std::filesystem::path& path) {
    std::vector<int> codes;
    for (const float value : read_picture(path).rgb) codes.push_back(static_cast<int>(std::lround(value * 255.0f)));
    return codes;
}

std::vector<int> png_codes(const Picture& picture) {
    const ScratchFolder folder;
    write_picture(folder / "a.png", picture);
    return codes_of(folder / "a.png");
}

// The longest run of equal codes in a list.
int longest_run(const std::vector<int>& codes) {
    int longest = 0, run = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        run = i > 0 && codes[i] == codes[i - 1] ? run + 1 : 1;
        longest = std::max(longest, run);
    }
    return longest;
}

}  // namespace

TEST_CASE("all thresholds occur once in any 1024 pixels of a row or a column") {
    for (const int start : {0, 1, 777, 16000}) {
        std::set<int> row, column;
        for (int i = start; i < start + kDitherLevels; ++i) {
            row.insert(dither_place(i, 3));
            column.insert(dither_place(5, i));
        }
        CHECK(row.size() == kDitherLevels);
        CHECK(column.size() == kDitherLevels);
    }
}

TEST_CASE("pixels of near thresholds lie far apart, as is said of the factors") {
    double least = 1e9;
    for (int dy = 0; dy <= 40; ++dy) {
        for (int dx = -40; dx <= 40; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const int place = dither_place(dx, dy);
            const int apart = std::min(place, kDitherLevels - place);
            least = std::min(least, (dx * dx + dy * dy) * (apart + 1.0) / kDitherLevels);
        }
    }
    CHECK(least >= 0.287);
    MESSAGE("least squared distance by threshold: ", least);
}

TEST_CASE("an even value is dithered to its mean, by the two codes beside it") {
    for (const double value : {0.3, 17.25, 100.5, 128.9, 254.01}) {
        const double light = decode_srgb(value / 255.0);
        const std::vector<int> codes = png_codes(picture_of(1024, 3, [&](int, int, int) { return light; }));
        double sum = 0;
        for (const int code : codes) {
            sum += code;
            if (code != std::floor(value) && code != std::ceil(value)) FAIL("code " << code << " for " << value);
        }
        CHECK(std::fabs(sum / static_cast<double>(codes.size()) - value) <= 0.5 / kDitherLevels + 1e-4);
    }
}

TEST_CASE("black stays 0, white and beyond stay 255, and what was a code comes back as it") {
    const std::vector<int> codes = png_codes(picture_of(256, 64, [](int x, int, int c) {
        return c == 0 ? decode_srgb(x / 255.0) : c == 1 ? -1.0 * (x % 2) : x % 2 ? 1.0 : 1e30;
    }));
    int wrong = 0;
    for (int i = 0; i < 256 * 64; ++i)
        wrong += (codes[3 * i] != i % 256) + (codes[3 * i + 1] != 0) + (codes[3 * i + 2] != 255);
    CHECK(wrong == 0);
}

TEST_CASE("a slow gradient shows no band: no long run of one code along it or across it, and no edge") {
    constexpr int kWidth = 512, kHeight = 256;
    for (const double slope : {0.25, 0.1, 0.02, 0.004}) {
        CAPTURE(slope);
        const auto value = [&](int x) { return 60.0 + slope * x; };
        // Nearer to a code most pixels are of it, as they should.
        const auto is_between = [&](int x) { return std::fabs(value(x) - std::round(value(x))) > 0.2; };
        const std::vector<int> codes =
            png_codes(picture_of(kWidth, kHeight, [&](int x, int, int) { return decode_srgb(value(x) / 255.0); }));
        const auto code = [&](int x, int y) { return codes[3 * (y * kWidth + x)]; };
        int across = 0, along = 0;
        for (int x = 0; x < kWidth; ++x) {
            std::vector<int> column;
            for (int y = 0; is_between(x) && y < kHeight; ++y) column.push_back(code(x, y));
            across = std::max(across, longest_run(column));
        }
        for (int y = 0; y < kHeight; ++y) {
            std::vector<int> row;
            for (int x = 0; x < kWidth; ++x) {
                if (is_between(x)) row.push_back(code(x, y));
                if (!is_between(x)) along = std::max(along, longest_run(std::exchange(row, {})));
            }
            along = std::max(along, longest_run(row));
        }
        double steepest = 0;  // by how much more of the rows rise than fall between two columns
        for (int x = 1; x < kWidth; ++x) {
            int rise = 0;
            for (int y = 0; y < kHeight; ++y) rise += code(x, y) - code(x - 1, y);
            steepest = std::max(steepest, static_cast<double>(rise) / kHeight);
        }
        // Rounded to the nearest code, whole columns of 256 are equal, rows for 1/slope, and all rows rise at once.
        CHECK(across <= 12);
        CHECK(along <= 12);
        CHECK(steepest <= slope + 0.1);
        MESSAGE("runs across ", across, ", along ", along, ", steepest edge ", steepest);
    }
}

TEST_CASE("a crop is dithered as the same pixels of the whole frame, in PNG and on a canvas") {
    const ScratchFolder folder;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> light(0.0f, 1.0f);
    const Picture whole = picture_of(90, 150, [&](int, int, int) { return light(random); });
    Picture crop{90, 150, 13, 71, 64, 141, {}};
    for (int y = crop.y0; y < crop.y1; ++y)
        for (int i = 3 * crop.x0; i < 3 * crop.x1; ++i) crop.rgb.push_back(whole.rgb[3 * y * 90 + i]);
    const std::vector<int> all = png_codes(whole), part = png_codes(crop);
    const Canvas canvas = to_canvas(crop);
    int wrong = 0;
    for (int y = 0; y < crop.height(); ++y) {
        for (int i = 0; i < 3 * crop.width(); ++i) {
            const int expected = all[3 * ((y + crop.y0) * 90 + crop.x0) + i];
            const std::size_t at = 3 * static_cast<std::size_t>(y * crop.width()) + i;
            wrong += part[at] != expected;
            wrong += std::lround(canvas.rgb[at] * 255.0f) != expected;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("grey stays grey") {
    const std::vector<int> codes = png_codes(picture_of(300, 200, [](int x, int y, int) { return (x + y) / 500.0; }));
    int coloured = 0;
    for (std::size_t i = 0; i < codes.size(); i += 3) coloured += codes[i] != codes[i + 1] || codes[i] != codes[i + 2];
    CHECK(coloured == 0);
}
