#include <doctest/doctest.h>

#include <limits>
#include <random>

#include "src/image/image_error.h"
#include "src/image/metadata.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

constexpr const char* kExtensions[] = {".exr", ".png", ".tiff", ".jpg"};

// Everything that TOML, line-based or XML-minded readers could stumble over.
const std::string kAwkward =
    "title = \"\xc3\x89t\xc3\xa9 \xe2\x80\x94 <a> & ']]>' %d \\n\"\r\n\n# strata:seed = 7\n\ttab = 1\nback\\slash = "
    "'x\\'\n = \n";

std::string long_text(std::size_t size) {
    std::string text;
    for (int line = 0; text.size() < size; ++line) text += "key_" + std::to_string(line) + " = 0.5  # words\n";
    return text;
}

}  // namespace

TEST_CASE("metadata comes back from every format, byte for byte") {
    const ScratchFolder folder;
    Metadata metadata;
    metadata.set(kSceneKey, kAwkward);
    metadata.set("strata:seed", std::numeric_limits<std::uint64_t>::max());
    metadata.set("strata:frame", -3);
    metadata.set("strata:tolerance", 0.1);
    metadata.set("strata:empty", "");
    metadata.set("strata:long", long_text(30'000));
    for (const char* extension : kExtensions) {
        CAPTURE(extension);
        const auto path = folder / (std::string("meta") + extension);
        write_picture(path, make_picture(3, 2), metadata);
        for (const auto& [name, value] : metadata.entries()) {
            CAPTURE(name);
            const auto found = read_metadata(path, name);
            // An empty text may be dropped by a format; that reads as nothing.
            if (value.empty() && !found) continue;
            REQUIRE(found.has_value());
            CHECK(*found == value);
        }
        CHECK(!read_metadata(path, "strata:nothing").has_value());
    }
    CHECK(metadata.find("strata:seed") == "18446744073709551615");
    CHECK(metadata.find("strata:tolerance") == "0.1");
}

TEST_CASE("packing and unpacking is the identity for random texts") {
    std::mt19937 random(11);
    const std::string alphabet = "ab=\\nr \n\r\t\"'\xc3\xa9:";
    std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
    std::uniform_int_distribution<int> length(0, 40);
    for (int trial = 0; trial < 2000; ++trial) {
        Metadata metadata;
        for (int entry = 0; entry < 4; ++entry) {
            std::string value;
            for (int i = length(random); i > 0; --i) value += alphabet[letter(random)];
            metadata.set("strata:" + std::to_string(entry), value);
        }
        CAPTURE(trial);
        REQUIRE(unpack(pack(metadata)).entries() == metadata.entries());
    }
}

TEST_CASE("unpacking skips what it did not write") {
    CHECK(unpack("").entries().empty());
    CHECK(unpack("A photograph\nof a = b\n\nstrata:a=1\n = x\n").entries().empty());
    CHECK(unpack("junk\nstrata:a = 1").find("strata:a") == "1");
}

TEST_CASE("a later value replaces an earlier one in its place") {
    Metadata metadata;
    metadata.set("strata:a", 1);
    metadata.set("strata:b", 2);
    metadata.set("strata:a", "three");
    CHECK(metadata.entries() == std::vector<Metadata::Entry>{{"strata:a", "three"}, {"strata:b", "2"}});
}

TEST_CASE("names and values that a format could not hold are refused") {
    Metadata metadata;
    for (const char* name :
         {"", "strata:", "scene", "DateTime", "strata:a b", "strata:a=b", "strata:\xc3\xa9", "strata:\n"})
        CHECK_THROWS_AS(metadata.set(name, "x"), ImageError);
    CHECK_THROWS_AS(metadata.set("strata:" + std::string(73, 'n'), "x"), ImageError);
    CHECK_NOTHROW(metadata.set("strata:" + std::string(72, 'n'), "x"));
    CHECK_THROWS_AS(metadata.set("strata:a", std::string_view("a\0b", 3)), ImageError);
}

TEST_CASE("text too long for TIFF and JPEG is refused there and kept by EXR and PNG") {
    const ScratchFolder folder;
    Metadata metadata;
    metadata.set(kSceneKey, long_text(200'000));
    for (const char* name : {"a.tif", "a.jpg"})
        CHECK_THROWS_AS(write_picture(folder / name, make_picture(1, 1), metadata), ImageError);
    CHECK(folder.names().empty());
    for (const char* name : {"a.exr", "a.png"}) {
        write_picture(folder / name, make_picture(1, 1), metadata);
        CHECK(read_metadata(folder / name, kSceneKey) == metadata.find(kSceneKey));
    }
    metadata.set(kSceneKey, std::string(60'000 - 16, 'x'));  // "strata:scene = " and the line's end make it 60,000
    for (const char* name : {"a.tif", "a.jpg"}) {
        write_picture(folder / name, make_picture(1, 1), metadata);
        CHECK(read_metadata(folder / name, kSceneKey) == metadata.find(kSceneKey));
    }
}
