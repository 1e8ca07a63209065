#include "src/image/png_text.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include <cstdint>
#include <map>
#include <vector>

#include "src/image/digest.h"
#include "src/image/picture_stream.h"
#include "src/image/png_chunks.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;

namespace {

struct Chunk {
    std::string type, data;
    bool is_right = false;  // by its checksum
};

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = at; i < at + 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes.at(i));
    return number;
}

std::vector<Chunk> chunks_of(const std::filesystem::path& png) {
    const std::string bytes = file_bytes(png);
    std::vector<Chunk> chunks;
    for (std::size_t at = 8; at < bytes.size();) {
        const std::uint32_t length = number_at(bytes, at);
        const std::string checked = bytes.substr(at + 4, 4 + length);
        const auto* data = reinterpret_cast<const unsigned char*>(checked.data());
        const bool is_right = crc32(0, data, static_cast<uInt>(checked.size())) == number_at(bytes, at + 8 + length);
        chunks.push_back({checked.substr(0, 4), checked.substr(4), is_right});
        at += 12 + length;
    }
    return chunks;
}

using namespace std::string_literals;

const std::string kTitle = "title = \"Höhenzug – 山の上 🏔\"\n";

Metadata awkward_metadata() {
    Metadata metadata;
    metadata.set(kSceneKey, kTitle);
    metadata.set("strata:plain", "a text of ASCII alone");
    metadata.set("strata:bytes", "no UTF-8: \xe9\xff");
    metadata.set("strata:columns", "label='naïve'");
    return metadata;
}

}  // namespace

TEST_CASE("text of a PNG beyond ASCII is UTF-8 in an iTXt, other text and the digest are in a tEXt") {
    const ScratchFolder folder;
    const Metadata metadata = awkward_metadata();
    const auto path = folder / "a.png";
    write_picture(path, make_picture(5, 4), metadata);
    std::map<std::string, std::string> text, utf8;
    std::string types;
    for (const Chunk& chunk : chunks_of(path)) {
        CHECK(chunk.is_right);
        types += chunk.type + " ";
        const std::size_t end = chunk.data.find('\0');
        if (chunk.type == "tEXt") text[chunk.data.substr(0, end)] = chunk.data.substr(end + 1);
        if (chunk.type != "iTXt") continue;
        CHECK(chunk.data.substr(end, 5) == "\0\0\0\0\0"s);  // plain, of no language
        utf8[chunk.data.substr(0, end)] = chunk.data.substr(end + 5);
    }
    CHECK(types.starts_with("IHDR iTXt iTXt "));
    CHECK(types.ends_with("IDAT IEND "));
    CHECK(utf8 == std::map<std::string, std::string>{{"strata:scene", kTitle}, {"strata:columns", "label='naïve'"}});
    for (const auto& [name, value] : utf8) CHECK(!text.contains(name));
    CHECK(text["strata:plain"] == "a text of ASCII alone");
    CHECK(text["strata:bytes"] == "no UTF-8: \xe9\xff");
    CHECK(text["strata:digest"].starts_with("xxh64 "));
    CHECK(read_facts(path).integrity == Integrity::whole);
    for (const auto& [name, value] : metadata.entries()) CHECK(read_metadata(path, name) == value);
}

TEST_CASE("a PNG with such text is the same file streamed, whole or in part, and as a canvas") {
    const ScratchFolder folder;
    const Metadata metadata = awkward_metadata();
    const Picture picture = make_picture(50, 70);
    write_picture(folder / "a.png", picture, metadata);
    PictureStream stream(folder / "b.png", picture.shape(), metadata, {});
    const std::span<const float> rgb(picture.rgb);
    const std::size_t strip = 3 * 50 * kStripRows;
    stream.write(rgb.first(strip));
    stream.write(rgb.subspan(strip));
    stream.finish();
    CHECK(file_bytes(folder / "a.png") == file_bytes(folder / "b.png"));
    PictureStream partial(folder / "c.png", picture.shape(), {}, {});
    partial.write(rgb.first(strip));
    partial.finish_partial(folder / "d.png", metadata);
    CHECK(read_metadata(folder / "d.png", kSceneKey) == kTitle);
    CHECK(read_facts(folder / "d.png").integrity == Integrity::whole);
}

TEST_CASE("what is UTF-8 beyond ASCII is told from what is not") {
    for (const char* text : {"é", "a–b", "山", "🏔", "\xc2\x80", "\xf4\x8f\xbf\xbf"}) CHECK(needs_utf8_chunk(text));
    for (const char* text :
         {"", "plain\n", "\xe9", "\xc3", "é\xff", "\xe5\xb1", "\x80", "\xc0\xaf", "\xf5\x80\x80\x80"})
        CHECK(!needs_utf8_chunk(text));
}
