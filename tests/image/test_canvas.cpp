#include "src/image/canvas.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "src/image/image_error.h"
#include "src/image/not_finite.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

Picture random_picture(int width, int height, float top) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> value(-0.1f, top);
    Picture picture = make_picture(width, height);
    for (float& v : picture.rgb) v = value(random);
    return picture;
}

Colour pixel(const Canvas& canvas, int x, int y) {
    const float* rgb = &canvas.rgb[3 * (static_cast<std::size_t>(y) * canvas.width + x)];
    return {rgb[0], rgb[1], rgb[2]};
}

Canvas noise_canvas(int width, int height) { return {width, height, random_picture(width, height, 1.0f).rgb}; }

template <class Act>
std::string error_of(const Act& act) {
    try {
        act();
    } catch (const ImageError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a canvas shows radiance by the very codes of a PNG with the same exposure") {
    const ScratchFolder folder;
    const Picture picture = random_picture(97, 83, 1.3f);
    for (const double exposure : {0.0, 1.0, -2.5, 0.37, 1e9}) {
        write_picture(folder / "linear.png", picture, {}, {.colour = {.exposure = exposure}});
        const Canvas canvas = to_canvas(picture, {.exposure = exposure});
        write_canvas(folder / "canvas.png", canvas);
        CHECK(read_picture(folder / "linear.png").rgb == canvas.rgb);
        CHECK(read_picture(folder / "canvas.png").rgb == canvas.rgb);
    }
}

TEST_CASE("pixels that are not finite are shown in a colour of their own, and counted") {
    Picture picture = random_picture(3, 3, 1.0f);
    CHECK(describe_not_finite(picture).empty());
    const Canvas before = to_canvas(picture);
    picture.rgb[5] = std::numeric_limits<float>::quiet_NaN();
    CHECK(describe_not_finite(picture).find("1 pixel is not finite, first (1,0) = (") == 0);
    picture.rgb[24] = -std::numeric_limits<float>::infinity();
    picture.rgb[25] = std::numeric_limits<float>::infinity();
    CHECK(describe_not_finite(picture).find("2 pixels are not finite, first (1,0) = (") == 0);
    const Canvas canvas = to_canvas(picture);
    for (int i = 0; i < 9; ++i) {
        const bool is_bad = i == 1 || i == 8;
        CHECK(pixel(canvas, i % 3, i / 3) == (is_bad ? kNotFiniteColour : pixel(before, i % 3, i / 3)));
    }
}

TEST_CASE("magnification replicates pixels, a crop keeps them") {
    const Canvas canvas = noise_canvas(13, 7);
    for (const int zoom : {1, 2, 3, 7, 8, 64}) {
        const Canvas large = magnify(canvas, zoom);
        REQUIRE(large.width == 13 * zoom);
        REQUIRE(large.height == 7 * zoom);
        bool same = true;
        for (int y = 0; y < large.height; ++y)
            for (int x = 0; x < large.width; ++x) same &= pixel(large, x, y) == pixel(canvas, x / zoom, y / zoom);
        CHECK_MESSAGE(same, "zoom " << zoom);
    }
    const Canvas part = crop(canvas, {3, 2, 11, 7});
    REQUIRE(part.box() == Box{0, 0, 8, 5});
    bool same = true;
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 8; ++x) same &= pixel(part, x, y) == pixel(canvas, x + 3, y + 2);
    CHECK(same);
}

TEST_CASE("crops outside of the canvas and magnifications beyond every format are refused") {
    const Canvas canvas = noise_canvas(13, 7);
    for (const Box& box : {Box{0, 0, 14, 7}, {-1, 0, 3, 3}, {5, 5, 5, 6}, {6, 5, 5, 6}, {0, 7, 13, 8}}) {
        CHECK(error_of([&] { crop(canvas, box); }).find("13x7") != std::string::npos);
    }
    CHECK(!error_of([&] { magnify(canvas, 0); }).empty());
    CHECK(error_of([&] { magnify(canvas, 5039); }).find("65500") != std::string::npos);
}

TEST_CASE("what is pasted or filled partly or wholly outside leaves the rest as it was") {
    const Canvas before = noise_canvas(20, 10);
    const Canvas patch = noise_canvas(6, 5);
    const Colour red{1, 0, 0};
    for (const auto& [px, py] : {std::pair{0, 0}, {-3, -2}, {17, 8}, {100, 3}, {-6, 0}, {0, -5}, {7, 3}}) {
        Canvas pasted = before, filled = before;
        paste(pasted, patch, px, py);
        fill(filled, {px, py, px + 6, py + 5}, red);
        bool right = true;
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 20; ++x) {
                const bool covered = x >= px && x < px + 6 && y >= py && y < py + 5;
                right &= pixel(pasted, x, y) == (covered ? pixel(patch, x - px, y - py) : pixel(before, x, y));
                right &= pixel(filled, x, y) == (covered ? red : pixel(before, x, y));
            }
        CHECK_MESSAGE(right, "at " << px << "," << py);
    }
}

TEST_CASE("an outline lies around its box and covers nothing in it") {
    const Canvas before = noise_canvas(20, 12);
    const Colour blue{0, 0, 1};
    for (const int thickness : {1, 2, 3}) {
        Canvas canvas = before;
        const Box box{5, 4, 12, 9};
        outline(canvas, box, blue, thickness);
        bool right = true;
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 20; ++x) {
                const int distance = std::max({box.x0 - x, x - box.x1 + 1, box.y0 - y, y - box.y1 + 1});
                const bool on_line = distance >= 1 && distance <= thickness;
                right &= pixel(canvas, x, y) == (on_line ? blue : pixel(before, x, y));
            }
        CHECK_MESSAGE(right, "thickness " << thickness);
    }
}

TEST_CASE("equal canvases are equal files with their metadata, however far apart") {
    const ScratchFolder folder;
    const Canvas canvas = noise_canvas(30, 20);
    Metadata metadata;
    metadata.set("strata:strip", "none; N=2");
    for (const char* extension : {".png", ".jpg", ".tif"})
        write_canvas(folder / (std::string("first") + extension), canvas, metadata);
    usleep(1'100'000);
    for (const char* extension : {".png", ".jpg", ".tif"}) {
        const auto second = folder / (std::string("second") + extension);
        write_canvas(second, canvas, metadata);
        CHECK(file_bytes(second) == file_bytes(folder / (std::string("first") + extension)));
        CHECK(read_metadata(second, "strata:strip") == "none; N=2");
    }
}

TEST_CASE("an EXR, which holds light, is refused for a canvas and nothing is written") {
    const ScratchFolder folder;
    CHECK(error_of([&] { write_canvas(folder / "a.exr", noise_canvas(2, 2)); }).find(".png") != std::string::npos);
    CHECK(folder.names().empty());
}
