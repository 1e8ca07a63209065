#include "src/image/file_paths.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "tests/image/scratch_folder.h"

using namespace strata::image;
namespace fs = std::filesystem;

TEST_CASE("what is derived from a name fits where the name fits, and differs where the names differ") {
    const fs::path folder = "/tmp";
    CHECK(derived_path("a/b.exr", ".partial.exr") == "a/b.partial.exr");
    const std::string longest(251, 'n');
    const fs::path one = derived_path(folder / (longest + ".exr"), ".partial.exr");
    const fs::path two = derived_path(folder / (longest.substr(1) + "m.exr"), ".partial.exr");
    CHECK(one.filename().string().size() == 255);
    CHECK(one.extension() == ".exr");
    CHECK(one != two);
    // 125 letters of two bytes each: none is cut in halves.
    std::string letters;
    for (int i = 0; i < 125; ++i) letters += "\xc3\xbc";
    const std::string cut = fitting_name(letters, ".partial.exr");
    CHECK(cut.size() <= 255);
    const std::size_t mark = cut.find('~');
    REQUIRE(mark != std::string::npos);
    CHECK(mark % 2 == 0);
}

TEST_CASE("two paths are one file by spelling, by links of either kind and before the file is there") {
    const ScratchFolder folder;
    fs::create_directory(folder / "d");
    fs::create_directory_symlink("d", folder / "e");
    fs::create_symlink("d/new", folder / "link");
    write_bytes(folder / "d/old", "");
    fs::create_hard_link(folder / "d/old", folder / "hard");
    CHECK(is_one_file(folder / "d/new", folder / "./d/../e/new"));
    CHECK(is_one_file(folder / "link", folder / "e/new"));
    CHECK(is_one_file(folder / "hard", folder / "e/old"));
    CHECK(!is_one_file(folder / "d/new", folder / "d/other"));
    CHECK(!is_one_file("-", "-"));
}
