#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "src/image/image_error.h"
#include "src/image/openimageio.h"
#include "src/image/picture_stream.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;
namespace fs = std::filesystem;

namespace {

constexpr const char* kExtensions[] = {".exr", ".png", ".tif", ".jpg"};

// A crop of a larger frame, smooth enough for a second JPEG encoding to be close.
Picture test_picture(int width, int height) {
    Picture picture{width + 30, height + 20, 11, 7, 11 + width, 7 + height, {}};
    std::mt19937 random(3);
    std::uniform_real_distribution<float> grain(0.0f, 0.02f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int c : {3, 5, 7})
                picture.rgb.push_back(static_cast<float>((x * c + y) % 97) / 97.0f + grain(random));
    return picture;
}

Metadata test_metadata() {
    Metadata metadata;
    metadata.set("strata:scene", "a = 1\n");
    return metadata;
}

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Strips [0,end) of the picture.
void write_strips(PictureStream& stream, const Picture& picture, std::size_t end) {
    const std::size_t strip = 3 * kStripRows * static_cast<std::size_t>(picture.width());
    for (std::size_t i = 0; i < end && i * strip < picture.rgb.size(); ++i) {
        stream.write(std::span(picture.rgb).subspan(i * strip, std::min(strip, picture.rgb.size() - i * strip)));
    }
}

}  // namespace

TEST_CASE("a streamed picture is the written one, byte by byte, whatever its size, layout and format") {
    const ScratchFolder folder;
    for (const int height : {1, 63, 64, 65, 200}) {
        const Picture picture = test_picture(83, height);
        for (const ExrLayout layout : {ExrLayout::scanlines, ExrLayout::tiles}) {
            for (const ExrFormat format : {ExrFormat::half, ExrFormat::floating}) {
                for (const std::string extension : kExtensions) {
                    const WriteOptions options{.colour = {.exposure = 0.5}, .exr_format = format, .exr_layout = layout};
                    write_picture(folder / ("whole" + extension), picture, test_metadata(), options);
                    PictureStream stream(folder / ("streamed" + extension), picture.shape(), test_metadata(), options);
                    CHECK(!fs::exists(folder / ("streamed" + extension)));
                    write_strips(stream, picture, 100);
                    stream.finish();
                    CHECK(bytes_of(folder / ("whole" + extension)) == bytes_of(folder / ("streamed" + extension)));
                    fs::remove(folder / ("streamed" + extension));
                }
            }
        }
    }
}

TEST_CASE("tiles hold the same pixels, window and metadata as scanlines, and come from 4096 pixels on by themselves") {
    const ScratchFolder folder;
    const auto is_tiled = [&](const char* name) {
        const std::string bytes = bytes_of(folder / name);
        return bytes.size() > 5 && (bytes[5] & 2) != 0;  // the version field's single-part tiled bit
    };
    const Picture picture = test_picture(150, 131);
    write_picture(folder / "tiles.exr", picture, test_metadata(), {.exr_layout = ExrLayout::tiles});
    write_picture(folder / "lines.exr", picture, test_metadata());
    const Picture tiles = read_picture(folder / "tiles.exr");
    const Picture lines = read_picture(folder / "lines.exr");
    CHECK(is_tiled("tiles.exr"));
    CHECK(!is_tiled("lines.exr"));
    CHECK(tiles.rgb == lines.rgb);
    CHECK(tiles.x0 == picture.x0);
    CHECK(tiles.y1 == picture.y1);
    CHECK(tiles.frame_width == picture.frame_width);
    CHECK(read_metadata(folder / "tiles.exr", "strata:scene") == read_metadata(folder / "lines.exr", "strata:scene"));
    for (const auto& [width, height] : {std::pair{4095, 2}, {4096, 2}, {2, 4096}}) {
        write_picture(folder / "large.exr", test_picture(width, height));
        CHECK(is_tiled("large.exr") == (std::max(width, height) >= 4096));
    }
    write_picture(folder / "large.exr", test_picture(4096, 2), {}, {.exr_layout = ExrLayout::scanlines});
    CHECK(!is_tiled("large.exr"));
}

TEST_CASE("a partial picture keeps what was written, is black below, and says so in its own metadata") {
    const ScratchFolder folder;
    const Picture picture = test_picture(90, 300);
    Metadata partial = test_metadata();
    partial.set("strata:partial", "yes");
    for (const ExrLayout layout : {ExrLayout::scanlines, ExrLayout::tiles}) {
        for (const std::string extension : kExtensions) {
            for (const std::size_t strips : {0, 2, 5}) {
                const WriteOptions options{.exr_layout = layout};
                Picture expected = picture;
                const std::size_t kept = std::min(strips * kStripRows * 3 * 90, expected.rgb.size());
                std::fill(expected.rgb.begin() + static_cast<std::ptrdiff_t>(kept), expected.rgb.end(), 0.0f);
                write_picture(folder / ("expected" + extension), expected, partial, options);
                PictureStream stream(folder / ("a" + extension), picture.shape(), test_metadata(), options);
                write_strips(stream, picture, strips);
                stream.finish_partial(folder / ("a.partial" + extension), partial);
                CHECK(!fs::exists(folder / ("a" + extension)));
                if (extension != ".jpg") {
                    CHECK(bytes_of(folder / ("a.partial" + extension)) == bytes_of(folder / ("expected" + extension)));
                    continue;
                }
                const Picture found = read_picture(folder / "a.partial.jpg"),
                              once = read_picture(folder / "expected.jpg");
                double sum = 0;
                for (std::size_t i = 0; i < found.rgb.size(); ++i) sum += std::abs(found.rgb[i] - once.rgb[i]);
                const double mean_codes = 255 * sum / static_cast<double>(found.rgb.size());
                MESSAGE("JPEG encoded twice differs by " << mean_codes << " codes");
                CHECK(mean_codes < 1);
                CHECK(read_metadata(folder / "a.partial.jpg", "strata:partial") == "yes");
            }
        }
    }
}

TEST_CASE("an EXR's channels beside its colours keep their values to the last bit, in partial pictures too") {
    const ScratchFolder folder;
    const Picture picture = test_picture(70, 150);
    std::vector<float> extra;
    for (std::size_t i = 0; i < 2 * picture.pixels(); ++i) extra.push_back(1e5f + static_cast<float>(i) / 7);
    const std::vector<std::string> in_order{"evals.Y", "steps.Y"}, in_another{"N.X", "Z"};
    for (const auto& [layout, extra_names] :
         {std::pair(ExrLayout::scanlines, in_order), std::pair(ExrLayout::tiles, in_order),
          std::pair(ExrLayout::scanlines, in_another)}) {
        const WriteOptions plain{.exr_layout = layout};
        write_picture(folder / "plain.exr", picture, {}, plain);
        for (const bool is_partial : {false, true}) {
            WriteOptions options = plain;
            options.exr_extra = extra_names;
            PictureStream stream(folder / "a.exr", picture.shape(), {}, options);
            for (int y = 0; y < 150; y += kStripRows) {
                const auto begin = static_cast<std::size_t>(y * 70);
                const auto count = static_cast<std::size_t>(std::min(kStripRows, 150 - y) * 70);
                stream.write(std::span(picture.rgb).subspan(3 * begin, 3 * count),
                             std::span(extra).subspan(2 * begin, 2 * count));
            }
            if (is_partial) {
                stream.finish_partial(folder / "a.exr", test_metadata());
            } else {
                stream.finish();
            }
            const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
            REQUIRE(input);
            REQUIRE(input->spec().nchannels == 5);
            std::vector<float> all(5 * picture.pixels());
            REQUIRE(input->read_image(0, 0, 0, 5, OIIO::TypeDesc::FLOAT, all.data()));
            // A reader has an order of its own.
            const auto first = static_cast<std::size_t>(input->spec().channelindex(extra_names[0]));
            const auto second = static_cast<std::size_t>(input->spec().channelindex(extra_names[1]));
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < picture.pixels(); ++i) {
                wrong += all[5 * i + first] != extra[2 * i] || all[5 * i + second] != extra[2 * i + 1] ? 1 : 0;
            }
            CHECK(wrong == 0);
            CHECK(read_picture(folder / "a.exr").rgb == read_picture(folder / "plain.exr").rgb);
        }
    }
}

TEST_CASE("a stream that is given up leaves the folder as it was") {
    const ScratchFolder folder;
    const Picture picture = test_picture(20, 100);
    for (const std::string extension : kExtensions) {
        std::ofstream(folder / ("a" + extension)) << "earlier";
        {
            PictureStream stream(folder / ("a" + extension), picture.shape(), {}, {});
            write_strips(stream, picture, 1);
        }
        CHECK(bytes_of(folder / ("a" + extension)) == "earlier");
    }
    CHECK(folder.names().size() == std::size(kExtensions));
}

TEST_CASE("a streamed picture that is not finite is refused with the count and place of it all, and nothing is left") {
    const ScratchFolder folder;
    Picture picture = test_picture(20, 150);
    picture.rgb[3 * (70 * 20 + 4) + 1] = std::numeric_limits<float>::quiet_NaN();
    picture.rgb[3 * (140 * 20 + 1)] = std::numeric_limits<float>::infinity();
    for (const std::string extension : kExtensions) {
        PictureStream stream(folder / ("a" + extension), picture.shape(), {}, {});
        write_strips(stream, picture, 100);
        std::string message;
        try {
            stream.finish();
        } catch (const ImageError& error) {
            message = error.what();
        }
        CHECK_MESSAGE(message.find("2 pixels are not finite, first (15,77)") != std::string::npos, message);
    }
    CHECK(folder.names().size() == 0);
}

TEST_CASE("rows that are no strip are refused") {
    const ScratchFolder folder;
    const Picture picture = test_picture(10, 100);
    PictureStream stream(folder / "a.png", picture.shape(), {}, {});
    CHECK_THROWS_AS(stream.write(std::span(picture.rgb).subspan(0, 30)), ImageError);
    CHECK_THROWS_AS(stream.write(picture.rgb), ImageError);
}

TEST_CASE("what is finished is kept in the temporary folder where its own folder has gone") {
    const ScratchFolder folder, temporary;
    const Picture picture = test_picture(20, 100);
    const char* const before = std::getenv("TMPDIR");
    const std::string restored = before != nullptr ? before : "/tmp";
    ::setenv("TMPDIR", temporary.path().c_str(), 1);
    for (const std::string extension : kExtensions) {
        CAPTURE(extension);
        std::filesystem::create_directory(folder / "out");
        PictureStream stream(folder / ("out/a" + extension), picture.shape(), test_metadata(), {});
        write_strips(stream, picture, 1);
        std::filesystem::remove_all(folder / "out");
        std::string message;
        try {
            stream.finish_partial(folder / ("out/a.partial" + extension), test_metadata());
        } catch (const ImageError& error) {
            message = error.what();
        }
        const std::filesystem::path kept = temporary / ("a.kept" + extension);
        CHECK_MESSAGE(message.find(kept.string()) != std::string::npos, message);
        CHECK(read_picture(kept).height() == 100);
        CHECK(read_facts(kept).integrity == Integrity::whole);
    }
    ::setenv("TMPDIR", restored.c_str(), 1);
}

TEST_CASE("what a format does not hold is known without a pixel") {
    Metadata long_one;
    long_one.set("strata:long", std::string(60'001, 'x'));
    const PictureShape shape{100, 100, 0, 0, 100, 100};
    const auto refuses = [&](const char* path, const PictureShape& s, const Metadata& metadata, WriteOptions options) {
        try {
            check_encodable(path, s, metadata, options);
        } catch (const ImageError&) {
            return true;
        }
        return false;
    };
    for (const char* path : {"a.exr", "a.png", "a.tif", "a.jpg"}) {
        CHECK(!refuses(path, shape, {}, {}));
        CHECK(refuses(path, {100, 100, -1, 0, 100, 100}, {}, {}));
        CHECK(refuses(path, {100, 100, 0, 0, 100, 101}, {}, {}));
        CHECK(refuses(path, shape, {}, {.colour = {.exposure = std::numeric_limits<double>::infinity()}}));
    }
    CHECK(refuses("a.tif", shape, long_one, {}));
    CHECK(refuses("a.jpg", shape, long_one, {}));
    CHECK(!refuses("a.png", shape, long_one, {}));
    CHECK(refuses("a.jpg", {65501, 1, 0, 0, 65501, 1}, {}, {}));
    CHECK(!refuses("a.png", {65501, 1, 0, 0, 65501, 1}, {}, {}));
}
