#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <random>

#include "src/image/image_error.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/damage.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

template <class Body>
std::string error_of(Body body) {
    try {
        body();
    } catch (const ImageError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("what is no picture is refused by name and reason, whatever its extension") {
    const ScratchFolder folder;
    std::mt19937 random(3);
    std::string junk;
    for (int i = 0; i < 5000; ++i) junk += static_cast<char>(random());
    write_bytes(folder / "scene.toml", "title = 'x'\n");
    write_bytes(folder / "empty.png", "");
    write_bytes(folder / "text.exr", "not an image\n");
    write_bytes(folder / "junk.tif", junk);
    for (const char* name : {"scene.toml", "empty.png", "text.exr", "junk.tif"}) {
        const auto path = folder / name;
        CHECK(!is_picture(path));
        const std::string message = error_of([&] { read_picture(path); });
        CHECK(message.find(path.string()) != std::string::npos);
        CHECK(message.find("no EXR, PNG, TIFF or JPEG") != std::string::npos);
        CHECK(error_of([&] { read_metadata(path, "strata:scene"); }) == message);
    }
    CHECK(error_of([&] { read_picture(folder / "missing.png"); }).find("does not exist") != std::string::npos);
    CHECK(error_of([&] { read_picture(folder.path()); }).find("folder") != std::string::npos);
    CHECK(!is_picture(folder.path()));
    CHECK(!is_picture(folder / "missing.png"));
}

TEST_CASE("a picture is known by its content under any name") {
    const ScratchFolder folder;
    Metadata metadata;
    metadata.set(kSceneKey, "x = 1");
    for (const char* extension : {".exr", ".png", ".tif", ".jpg"}) {
        write_picture(folder / (std::string("a") + extension), make_picture(3, 2), metadata);
        std::filesystem::rename(folder / (std::string("a") + extension), folder / "nameless");
        CHECK(is_picture(folder / "nameless"));
        CHECK(read_picture(folder / "nameless").width() == 3);
        CHECK(read_metadata(folder / "nameless", kSceneKey) == "x = 1");
    }
}

TEST_CASE("a truncated picture is an error that names the file") {
    const ScratchFolder folder;
    std::mt19937 random(5);
    Picture picture = make_picture(64, 64);
    for (float& value : picture.rgb) value = std::uniform_real_distribution<float>()(random);
    for (const char* extension : {".exr", ".png", ".tif", ".jpg"}) {
        write_picture(folder / (std::string("whole") + extension), picture);
        const std::string whole = file_bytes(folder / (std::string("whole") + extension));
        const auto path = folder / (std::string("damaged") + extension);
        int refused = 0;
        for (const double part : {0.02, 0.1, 0.3, 0.5, 0.9}) {
            write_bytes(path, whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
            const std::string message = error_of([&] {
                [[maybe_unused]] const LibraryMayLeak tolerated;
                read_picture(path);
            });
            refused += !message.empty();
            if (!message.empty()) CHECK(message.find(path.string()) != std::string::npos);
        }
        MESSAGE(std::string(extension), ": refused ", refused, " of 5 truncated files");
        CHECK(refused == 5);
    }
}

TEST_CASE("linear radiance comes back from every format, the exposure undone") {
    const ScratchFolder folder;
    Picture picture = make_picture(16, 16);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = static_cast<float>(i) / 768.0f * 0.5f;
    for (const double exposure : {0.0, 0.9, -1.5}) {
        write_picture(folder / "a.exr", picture, {}, {{.exposure = exposure}, ExrFormat::floating});
        CHECK(read_linear(folder / "a.exr", {.exposure = exposure}).rgb == picture.rgb);
        // Half a code, or a whole one that is dithered, where the curve is steepest: its slope is at most 2.4 / 1.055
        // of light a code's unit.
        for (const auto& [name, codes] : {std::pair{"a.png", 255.0 / 2}, {"a.tif", 65535.0}}) {
            write_picture(folder / name, picture, {}, {{.exposure = exposure}, ExrFormat::half});
            const Picture read = read_linear(folder / name, {.exposure = exposure});
            const double bound = 0.5 / codes * 2.4 / 1.055 * std::exp2(-exposure) + 1e-7;
            double worst = 0;
            for (std::size_t i = 0; i < picture.rgb.size(); ++i)
                worst = std::max(worst, std::fabs(static_cast<double>(read.rgb[i]) - picture.rgb[i]) / bound);
            CHECK(worst <= 1);
            MESSAGE(std::string(name) << " at " << exposure << " stops, observed / bound: " << worst);
        }
    }
}
