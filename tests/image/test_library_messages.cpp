#include "src/image/library_noise.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>

#include "src/image/image_error.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/damage.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

template <class Act>
std::string error_of(const Act& act) {
    try {
        [[maybe_unused]] const LibraryMayLeak tolerated;
        act();
    } catch (const ImageError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("what is printed on standard error is kept while the noise is listened to, and shown again after it") {
    const LibraryNoise outer;
    {
        const LibraryNoise inner;
        CHECK(inner.text().empty());
        std::fprintf(stderr, "libpng error: IHDR: CRC error\nand more\n");
        [[maybe_unused]] const auto written = ::write(STDERR_FILENO, "x", 1);
        CHECK(inner.text() == "IHDR: CRC error");
        CHECK(inner.explain("Could not read\n") == "Could not read (IHDR: CRC error)");
        CHECK(inner.explain("bad: IHDR: CRC error") == "bad: IHDR: CRC error");
        CHECK(inner.explain("") == "IHDR: CRC error");
        CHECK(inner.explain("CRC error\na\nPNG: IHDR: CRC error\na \n") == "a; PNG: IHDR: CRC error");
    }
    CHECK(outer.text().empty());
    std::fprintf(stderr, "shown\n");
    CHECK(outer.text() == "shown");
}

TEST_CASE("a damaged picture is one message, with the library's reason in it and nothing beside it") {
    const ScratchFolder folder;
    for (const char* extension : {".png", ".tif", ".jpg", ".exr"}) {
        const auto path = folder / (std::string("whole") + extension);
        write_picture(path, make_picture(40, 30));
        std::string bytes = file_bytes(path);
        const auto cut = folder / (std::string("cut") + extension);
        for (const double part : {0.1, 0.3, 0.6, 0.95}) {
            write_bytes(cut, bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
            const LibraryNoise shown;
            const std::string read = error_of([&] { read_picture(cut); }), facts = error_of([&] { read_facts(cut); });
            CHECK(shown.text() == "");
            CHECK(!read.empty());
            CHECK(read.find('\n') == std::string::npos);
        }
    }
    const auto png = folder / "whole.png";
    std::string bytes = file_bytes(png);
    bytes[20] ^= 1;  // the width, in IHDR
    write_bytes(png, bytes);
    CHECK(error_of([&] { read_picture(png); }).find("IHDR: CRC error") != std::string::npos);
}

TEST_CASE("a picture that a library refuses to write is one message, with its reason in it and nothing beside it") {
    const ScratchFolder folder;
    const LibraryNoise shown;
    const std::string message = error_of([&] { write_picture(folder / "wide.png", make_picture(1'000'001, 1)); });
    CHECK(shown.text() == "");
    CHECK(message.find("wide.png") != std::string::npos);
    CHECK(message.find("IHDR") != std::string::npos);
}
