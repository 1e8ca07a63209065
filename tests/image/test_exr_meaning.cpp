#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include "src/image/image_error.h"
#include "src/image/openimageio.h"
#include "src/image/picture_stream.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

OIIO::ImageSpec spec_of(const std::filesystem::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    REQUIRE(input);
    return input->spec();
}

Picture picture_with(const std::vector<float>& rgb) {
    Picture picture{20, 10, 4, 2, 4 + static_cast<int>(rgb.size()) / 3, 3, rgb};
    return picture;
}

}  // namespace

TEST_CASE("an EXR names its primaries and white, and its frame rate where it is a frame of an animation") {
    const ScratchFolder folder;
    const std::array<float, 8> rec709{0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
    for (const ExrFormat format : {ExrFormat::half, ExrFormat::floating}) {
        write_picture(folder / "still.exr", make_picture(3, 2), {}, {.exr_format = format});
        const OIIO::ImageSpec still = spec_of(folder / "still.exr");
        std::array<float, 8> found{};
        CHECK(still.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), found.data()));
        CHECK(found == rec709);
        CHECK(still.find_attribute("FramesPerSecond") == nullptr);
        const WriteOptions options{.exr_format = format, .frames_per_second = FrameRate{24000, 1001}};
        write_picture(folder / "frame.exr", make_picture(3, 2), {}, options);
        std::array<int, 2> rate{};
        CHECK(spec_of(folder / "frame.exr").getattribute("FramesPerSecond", OIIO::TypeRational, rate.data()));
        CHECK(rate == std::array{24000, 1001});
        // OpenEXR's own name: OpenImageIO's begins with a capital, which no other program looks for.
        CHECK(file_bytes(folder / "frame.exr").find(std::string("framesPerSecond\0rational\0", 25)) !=
              std::string::npos);
        CHECK(read_facts(folder / "frame.exr").metadata.entries().empty());
    }
}

TEST_CASE("radiance beyond the largest half is clipped to it, counted by pixels, and told once the file is whole") {
    const ScratchFolder folder;
    const float huge = std::numeric_limits<float>::max();
    const Picture picture = picture_with({1, 2, 3, 65504, -65504, 0, 65505, 1, 1e30f, 0, -huge, 0.5f, 7, 8, 9});
    std::vector<std::string> told;
    const auto path = folder / "a.exr";
    const WriteOptions half{.warn = [&](const std::string& text) {
        CHECK(std::filesystem::exists(path.parent_path()));
        told.push_back(text);
    }};
    write_picture(path, picture, {}, half);
    REQUIRE(told.size() == 1);
    CHECK(told[0] == fmt::format("\"{}\": 2 pixels beyond 65504, the largest half, are clipped to it, first (6,2) = "
                                 "(65505, 1, 1e+30)",
                                 path.string()));
    const std::vector<float> read = read_picture(path).rgb;
    CHECK(read == std::vector<float>{1, 2, 3, 65504, -65504, 0, 65504, 1, 65504, 0, -65504, 0.5f, 7, 8, 9});

    told.clear();
    PictureStream stream(path, picture.shape(), {}, half);
    stream.write(picture.rgb);
    CHECK(told.empty());
    stream.finish();
    CHECK(told.size() == 1);
    PictureStream partial(path, picture.shape(), {}, half);
    partial.write(picture.rgb);
    partial.finish_partial(folder / "part.exr", {});
    REQUIRE(told.size() == 2);
    CHECK(told[1].find("part.exr") != std::string::npos);
    { const PictureStream given_up(path, picture.shape(), {}, half); }
    CHECK(told.size() == 2);

    WriteOptions floating = half;
    floating.exr_format = ExrFormat::floating;
    write_picture(path, picture, {}, floating);
    for (const char* name : {"a.png", "a.tif", "a.jpg"}) write_picture(folder / name, picture, {}, half);
    CHECK(told.size() == 2);
    CHECK(read_picture(path).rgb == picture.rgb);
}

TEST_CASE("a float EXR keeps what is not finite where that is asked for, and nothing else does") {
    const ScratchFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const Picture picture = picture_with({nan, 1, 2, infinity, -infinity, 3});
    const WriteOptions keeping{.exr_format = ExrFormat::floating, .keeps_not_finite = true};
    write_picture(folder / "a.exr", picture, {}, keeping);
    const std::vector<float> read = read_picture(folder / "a.exr").rgb;
    CHECK(std::isnan(read[0]));
    CHECK(std::vector<float>(read.begin() + 1, read.end()) == std::vector<float>{1, 2, infinity, -infinity, 3});
    WriteOptions half = keeping;
    half.exr_format = ExrFormat::half;
    CHECK_THROWS_AS(write_picture(folder / "b.exr", picture, {}, half), ImageError);
    CHECK_THROWS_AS(write_picture(folder / "b.png", picture, {}, keeping), ImageError);
    CHECK_THROWS_AS(write_picture(folder / "b.exr", picture, {}, {.exr_format = ExrFormat::floating}), ImageError);
    CHECK(folder.names() == std::vector<std::string>{"a.exr"});
}
