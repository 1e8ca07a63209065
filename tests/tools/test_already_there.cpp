#include "tools/job/already_there.h"

#include <doctest/doctest.h>

#include <random>

#include "src/image/digest.h"
#include "src/image/write.h"
#include "tests/image/damage.h"
#include "tests/image/scratch_folder.h"
#include "tools/figures/films.h"
#include "tools/figures/record.h"

using namespace strata::tools::figures;
using namespace strata::tools::job;
using namespace strata;

namespace {

constexpr const char* kExtensions[] = {".exr", ".png", ".tif", ".jpg"};

image::Picture test_picture() {
    std::mt19937 random(3);
    image::Picture picture = image::make_picture(60, 40);
    for (float& value : picture.rgb) value = std::uniform_real_distribution<float>()(random);
    return picture;
}

image::Metadata metadata_of(int seed) {
    image::Metadata metadata;
    metadata.set(image::kSceneKey, "title = \"x\"\nseed = " + std::to_string(seed) + "  # any\n");
    metadata.set("strata:seed", seed);
    return metadata;
}

Found find(const std::filesystem::path& path) {
    [[maybe_unused]] const image::LibraryMayLeak tolerated;
    return find_picture(path, metadata_of(1), test_picture().shape());
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a picture is there when it is whole and made by the same settings, and only then") {
    const ScratchFolder folder;
    for (const std::string extension : kExtensions) {
        CAPTURE(extension);
        const auto path = folder / ("a" + extension);
        CHECK(find(path).presence == Presence::missing);
        image::write_picture(path, test_picture(), metadata_of(1));
        CHECK(find(path).presence == Presence::same);

        image::write_picture(path, test_picture(), metadata_of(2));
        CHECK(find(path).presence == Presence::other);
        CHECK(contains(find(path).why, "strata:scene is 'seed = 2', not 'seed = 1'"));

        image::Metadata more = metadata_of(1);
        more.set("strata:partial", "40 of 60 rows");
        image::write_picture(path, test_picture(), more);
        CHECK(find(path).presence == Presence::other);
        CHECK(contains(find(path).why, "strata:partial is '40 of 60 rows'"));

        image::write_picture(path, image::make_picture(40, 60), metadata_of(1));
        CHECK(find(path).presence == Presence::other);
        CHECK(contains(find(path).why, "40x60 pixels, not 60x40"));
    }
}

TEST_CASE("a picture with one bit wrong, cut or empty is never taken for one that is there") {
    const ScratchFolder folder;
    std::mt19937 random(5);
    for (const std::string extension : kExtensions) {
        CAPTURE(extension);
        const auto path = folder / ("a" + extension);
        image::write_picture(path, test_picture(), metadata_of(1));
        const std::string bytes = file_bytes(path);
        int taken = 0, damaged = 0;
        for (int i = 0; i < 200; ++i) {
            write_bytes(path, image::with_flipped_bit(bytes, random));
            const Found found = find(path);
            taken += found.presence == Presence::same;
            damaged += found.presence == Presence::damaged;
        }
        CHECK(taken == 0);
        // What starts like no picture any more is another file.
        CHECK(damaged > 190);
        taken = damaged = 0;
        for (const std::size_t length : image::cut_lengths(bytes.size(), random)) {
            write_bytes(path, bytes.substr(0, length));
            taken += find(path).presence == Presence::same;
        }
        CHECK(taken == 0);
        write_bytes(path, bytes.substr(0, bytes.size() / 2));
        CHECK(find(path).presence == Presence::damaged);
        write_bytes(path, "");
        CHECK(find(path).presence == Presence::damaged);
        CHECK(find(path).why == "it is empty");
        write_bytes(path, bytes);
        CHECK(find(path).presence == Presence::same);
    }
}

TEST_CASE("what is no picture, and a cut picture of other settings, are no damage that may be written over") {
    const ScratchFolder folder;
    write_bytes(folder / "a.png", "shopping list\n");
    CHECK(find(folder / "a.png").presence == Presence::other);
    CHECK(find(folder.path()).presence == Presence::other);
    image::write_picture(folder / "a.png", test_picture(), metadata_of(2));
    const std::string bytes = file_bytes(folder / "a.png");
    write_bytes(folder / "a.png", bytes.substr(0, bytes.size() - 20));
    CHECK(find(folder / "a.png").presence == Presence::other);
}

TEST_CASE("a record vouches for each of its files, byte by byte") {
    const ScratchFolder folder;
    std::mt19937 random(7);
    const std::vector<std::string> files{"a.svg", "a.csv", "a.webm"};
    for (const std::string& file : files) write_bytes(folder / file, "content of " + file);
    const nlohmann::ordered_json record{{"figure", 1}, {"scale", 0.1}};
    const auto path = folder / "a.json";
    const auto is_made_now = [&](const nlohmann::ordered_json& expected) {
        return is_made(path, expected, files, true);
    };
    CHECK(!is_made_now(record));
    write_record(path, record, files);
    const std::string bytes = file_bytes(path);
    CHECK(bytes.find('\n') == bytes.size() - 1);
    CHECK(is_made_now(record));
    CHECK(!is_made_now({{"figure", 1}, {"scale", 0.2}}));
    for (const std::string& file : files) {
        const std::string whole = file_bytes(folder / file);
        for (const std::string& damaged : {std::string(), whole.substr(1), image::with_flipped_bit(whole, random)}) {
            write_bytes(folder / file, damaged);
            CHECK(!is_made_now(record));
        }
        std::filesystem::remove(folder / file);
        CHECK(!is_made_now(record));
        write_bytes(folder / file, whole);
        CHECK(is_made_now(record));
    }
    for (const std::string& damaged : {std::string(), bytes.substr(0, bytes.size() / 2), std::string("[1]\n")}) {
        write_bytes(path, damaged);
        CHECK(!is_made_now(record));
    }
}

TEST_CASE("a film is made when its record vouches for both of its files") {
    const ScratchFolder folder;
    const Film film = films(Size::small).front();
    const MakeOptions options{.folder = folder.path(), .size = Size::small, .quiet = true};
    const std::vector<std::string> files = film_files(film);
    for (const std::string& file : files) write_bytes(folder / file, "frames of " + file);
    CHECK(!is_made(film, options));
    write_record(folder / (film.name + ".json"), film_record(film), files);
    CHECK(is_made(film, options));
    CHECK(!is_made(films(Size::large).front(), options));
    for (const std::string& file : files) {
        const std::string whole = file_bytes(folder / file);
        for (const std::string& damaged : {std::string(), whole.substr(0, 5), "Frames" + whole.substr(6)}) {
            write_bytes(folder / file, damaged);
            CHECK(!is_made(film, options));
        }
        write_bytes(folder / file, whole);
        CHECK(is_made(film, options));
    }
}
