#include "src/image/digest.h"

#include <doctest/doctest.h>

#include <cstring>
#include <random>

#include "src/image/image_error.h"
#include "src/image/openimageio.h"
#include "src/image/picture_stream.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/damage.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

struct Kind {
    std::string name, extension;
    WriteOptions options{};
    bool is_streamed = false;
};

std::vector<Kind> all_kinds() {
    std::vector<Kind> kinds{{"half EXR", ".exr"},
                            {"float EXR", ".exr", {.exr_format = ExrFormat::floating}},
                            {"tiled EXR", ".exr", {.exr_layout = ExrLayout::tiles}},
                            {"PNG", ".png"},
                            {"TIFF", ".tif"},
                            {"JPEG", ".jpg"}};
    const std::size_t count = kinds.size();
    for (std::size_t i = 0; i < count; ++i) {
        kinds.push_back(kinds[i]);
        kinds.back().name += ", streamed";
        kinds.back().is_streamed = true;
    }
    return kinds;
}

// Half of it smooth, half noise: both what packs well and what formats store as it is.
Picture test_picture() {
    std::mt19937 random(11);
    Picture picture = make_picture(80, 100);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        picture.rgb[i] = i < picture.rgb.size() / 2 ? static_cast<float>(i % 240) / 240.0f
                                                    : std::uniform_real_distribution<float>()(random);
    }
    return picture;
}

Metadata test_metadata() {
    Metadata metadata;
    metadata.set(kSceneKey, "title = \"strata:digest = " + blank_digest() + "\"\n");
    metadata.set("strata:seed", 1);
    return metadata;
}

void write(const std::filesystem::path& path, const Picture& picture, const Kind& kind) {
    if (!kind.is_streamed) return write_picture(path, picture, test_metadata(), kind.options);
    PictureStream stream(path, picture.shape(), test_metadata(), kind.options);
    const std::size_t strip = 3 * static_cast<std::size_t>(picture.width()) * kStripRows;
    for (std::size_t begin = 0; begin < picture.rgb.size(); begin += strip) {
        stream.write(std::span(picture.rgb).subspan(begin, std::min(strip, picture.rgb.size() - begin)));
    }
    stream.finish();
}

bool same_bits(const Picture& a, const Picture& b) {
    return a.shape() == b.shape() && std::memcmp(a.rgb.data(), b.rgb.data(), sizeof(float) * a.rgb.size()) == 0;
}

// Empty when it is read.
std::string refusal_of(const std::filesystem::path& path, Picture& read) {
    [[maybe_unused]] const LibraryMayLeak tolerated;
    try {
        read = read_picture(path);
    } catch (const ImageError& error) {
        return error.what();
    }
    return "";
}

// As another program would write it: no digest.
void write_foreign(const std::filesystem::path& path, const Picture& picture, const char* compression, int tile) {
    OIIO::ImageSpec spec(picture.width(), picture.height(), 3, OIIO::TypeDesc::UINT16);
    spec.attribute("compression", compression);
    spec.tile_width = spec.tile_height = tile;
    const auto output = OIIO::ImageOutput::create(path.string());
    REQUIRE(output);
    REQUIRE(output->open(path.string(), spec));
    REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, picture.rgb.data()));
    REQUIRE(output->close());
}

}  // namespace

TEST_CASE("a file of every kind carries the digest of its own bytes") {
    const ScratchFolder folder;
    const Picture picture = test_picture();
    for (const Kind& kind : all_kinds()) {
        CAPTURE(kind.name);
        const auto path = folder / ("a" + kind.extension);
        write(path, picture, kind);
        const PictureFacts facts = read_facts(path);
        CHECK(facts.integrity == Integrity::whole);
        CHECK(facts.shape == picture.shape());
        CHECK(facts.metadata.find("strata:seed") == "1");
        CHECK(!facts.metadata.find(kDigestKey));
        CHECK(read_metadata(path, kDigestKey).value_or("").size() == blank_digest().size());
        CHECK(read_metadata(path, kDigestKey) != blank_digest());
        if (kind.extension != ".tif" && kind.extension != ".jpg")
            CHECK(facts.metadata.find(kSceneKey) == test_metadata().find(kSceneKey));
    }
}

TEST_CASE("a picture with one bit wrong anywhere is refused by name, or its pixels are the very ones") {
    const ScratchFolder folder;
    std::mt19937 random(13);
    for (const Kind& kind : all_kinds()) {
        CAPTURE(kind.name);
        const auto path = folder / ("a" + kind.extension), damaged = folder / ("b" + kind.extension);
        write(path, test_picture(), kind);
        const Picture whole = read_picture(path);
        const std::string bytes = file_bytes(path);
        int refused = 0, unnamed = 0, wrong = 0, trusted = 0;
        for (int i = 0; i < 200; ++i) {
            write_bytes(damaged, with_flipped_bit(bytes, random));
            Picture read;
            const std::string message = refusal_of(damaged, read);
            refused += !message.empty();
            unnamed += !message.empty() && message.find(damaged.string()) == std::string::npos;
            wrong += message.empty() && !same_bits(read, whole);
            trusted += says_whole(damaged);
        }
        CHECK(unnamed == 0);
        CHECK(wrong == 0);
        CHECK(trusted == 0);
        CHECK(refused > 150);
        MESSAGE(kind.name << ": refused " << refused << " of 200, the others have the same pixels");
    }
}

TEST_CASE("a picture cut at any length is refused, or its pixels are the very ones") {
    const ScratchFolder folder;
    std::mt19937 random(17);
    for (const Kind& kind : all_kinds()) {
        CAPTURE(kind.name);
        const auto path = folder / ("a" + kind.extension), damaged = folder / ("b" + kind.extension);
        write(path, test_picture(), kind);
        const Picture whole = read_picture(path);
        const std::string bytes = file_bytes(path);
        int wrong = 0, trusted = 0;
        for (const std::size_t length : cut_lengths(bytes.size(), random)) {
            write_bytes(damaged, bytes.substr(0, length));
            Picture read;
            const std::string message = refusal_of(damaged, read);
            wrong += message.empty() && !same_bits(read, whole);
            trusted += says_whole(damaged);
        }
        CHECK(wrong == 0);
        CHECK(trusted == 0);
    }
}

TEST_CASE("a deflated TIFF of another program with wrong bits among its pixels is refused by strip or tile") {
    const ScratchFolder folder;
    std::mt19937 random(19);
    const Picture picture = test_picture();
    const auto path = folder / "a.tif";
    for (const int tile : {0, 32}) {
        write_foreign(path, picture, "zip", tile);
        CHECK(read_facts(path).integrity == Integrity::unknown);
        const Picture whole = read_picture(path);
        const std::string bytes = file_bytes(path);
        int refused = 0, by_place = 0, wrong = 0;
        for (int i = 0; i < 200; ++i) {
            // Between the header, 8 bytes, and the directory: pixels.
            std::string flipped = bytes;
            flipped[200 + random() % (bytes.size() - 1200)] ^= static_cast<char>(1 << random() % 8);
            write_bytes(path, flipped);
            Picture read;
            const std::string message = refusal_of(path, read);
            refused += !message.empty();
            by_place += message.find(tile > 0 ? "tile " : "strip ") != std::string::npos;
            wrong += message.empty() && !same_bits(read, whole);
        }
        CHECK(wrong == 0);
        CHECK(refused > 195);
        CHECK(by_place > 195);
    }
}

TEST_CASE("a whole TIFF of another program is read, whatever its compression") {
    const ScratchFolder folder;
    const Picture picture = test_picture();
    write_foreign(folder / "first.tif", picture, "none", 0);
    const Picture first = read_picture(folder / "first.tif");
    for (const char* compression : {"none", "lzw", "zip", "packbits"}) {
        for (const int tile : {0, 32}) {
            write_foreign(folder / "a.tif", picture, compression, tile);
            CHECK(same_bits(read_picture(folder / "a.tif"), first));
        }
    }
}

TEST_CASE("a picture that another program cut smaller is read, though it passed the digest on") {
    const ScratchFolder folder;
    for (const char* extension : {".exr", ".png", ".tif", ".jpg"}) {
        CAPTURE(std::string(extension));
        const std::string path = (folder / (std::string("a") + extension)).string();
        write_picture(path, test_picture(), test_metadata());
        OIIO::ImageBuf whole(path);
        OIIO::ImageBuf part = OIIO::ImageBufAlgo::cut(whole, OIIO::ROI(0, 40, 0, 50));
        REQUIRE(part.write(path));
        CHECK(read_metadata(path, kDigestKey));
        CHECK(read_facts(path).integrity == Integrity::another_length);
        CHECK(read_picture(path).width() == 40);
    }
}

TEST_CASE("a digest kept beside a file tells when any of its bytes changes") {
    const ScratchFolder folder;
    std::mt19937 random(23);
    std::string bytes((std::size_t{1} << 21) + 77, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    const auto path = folder / "film.mp4";
    write_bytes(path, bytes);
    const std::string digest = digest_of_file(path);
    CHECK(digest.ends_with(" of 000000002097229 bytes"));
    for (const std::size_t at : {std::size_t{0}, std::size_t{1} << 20, (std::size_t{1} << 20) - 1, bytes.size() - 1}) {
        std::string flipped = bytes;
        flipped[at] ^= 1;
        write_bytes(path, flipped);
        CHECK(digest_of_file(path) != digest);
    }
    write_bytes(path, bytes);
    CHECK(digest_of_file(path) == digest);
}

TEST_CASE("what cannot be read has no digest, and the reason is told") {
    const ScratchFolder folder;
    const auto reason_of = [](const std::filesystem::path& path) -> std::string {
        try {
            return digest_of_file(path);
        } catch (const ImageError& error) {
            return error.what();
        }
    };
    const auto missing = folder / "missing";
    CHECK(reason_of(missing) == "cannot read \"" + missing.string() + "\": No such file or directory");
    // A folder is opened like a file; what fails is the first read.
    const auto opened = folder / "opened";
    std::filesystem::create_directory(opened);
    CHECK(reason_of(opened) == "cannot read \"" + opened.string() + "\": Is a directory");
    const std::string digest = "xxh64 0123456789abcdef of " + std::string(11, '0') + "4096 bytes";
    CHECK_THROWS_AS(check_digest(missing, Format::png, digest), ImageError);
}
