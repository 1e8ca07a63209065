#include "src/image/placing.h"

#include <doctest/doctest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cstdlib>
#include <set>

#include "src/image/encode.h"
#include "src/image/file_paths.h"
#include "src/image/image_error.h"
#include "src/image/output_file.h"
#include "src/image/picture_stream.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;
namespace fs = std::filesystem;

namespace {

void write_through(ScratchFile& file, const std::string& bytes) {
    REQUIRE(::pwrite(file.descriptor(), bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
}

// What place() says; empty if all went well.
std::string message_of_placing(ScratchFile& file) {
    try {
        file.place();
    } catch (const ImageError& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

struct stat facts_of(const fs::path& path) {
    struct stat facts {};
    REQUIRE(::lstat(path.c_str(), &facts) == 0);
    return facts;
}

mode_t mode_of(const fs::path& path) { return facts_of(path).st_mode & 07777; }

// The exit code of `body` in a child process, whose identity, mounts and environment end with it.
template <class Body>
int in_child(Body body) {
    const pid_t child = fork();
    if (child == 0) _exit(body());
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    return WEXITSTATUS(status);
}

// Permissions do not bind root.
bool become_nobody() { return geteuid() != 0 || (setgid(65534) == 0 && setuid(65534) == 0); }

}  // namespace

TEST_CASE("a replaced file keeps its mode, whatever the umask; a new one is as the umask says") {
    const ScratchFolder folder;
    const mode_t umask_before = ::umask(027);
    for (const mode_t mode : {0600u, 0644u, 0664u, 0777u}) {
        write_bytes(folder / "a", "earlier");
        REQUIRE(::chmod((folder / "a").c_str(), mode) == 0);
        replace_file(folder / "a", "later");
        CHECK(mode_of(folder / "a") == mode);
        CHECK(file_bytes(folder / "a") == "later");
    }
    replace_file(folder / "new", "text");
    CHECK(mode_of(folder / "new") == 0640);
    ::umask(umask_before);
}

TEST_CASE("a file that others may not read is not readable while it is made") {
    const ScratchFolder folder;
    write_bytes(folder / "a", "earlier");
    REQUIRE(::chmod((folder / "a").c_str(), 0600) == 0);
    const ScratchFile file(folder / "a");
    CHECK(mode_of(file.path()) == 0600);
}

TEST_CASE("a replaced file keeps its owner and group where that is permitted") {
    if (geteuid() != 0) return;
    const ScratchFolder folder;
    write_bytes(folder / "a", "earlier");
    REQUIRE(::chown((folder / "a").c_str(), 12345, 54321) == 0);
    REQUIRE(::chmod((folder / "a").c_str(), 0640) == 0);
    replace_file(folder / "a", "later");
    CHECK(facts_of(folder / "a").st_uid == 12345);
    CHECK(facts_of(folder / "a").st_gid == 54321);
    CHECK(mode_of(folder / "a") == 0640);
}

TEST_CASE("another group than the one that cannot be kept gets no more than everybody has") {
    if (geteuid() != 0) return;
    const ScratchFolder folder;
    write_bytes(folder / "a", "earlier");
    REQUIRE(::chown((folder / "a").c_str(), 65534, 54321) == 0);
    REQUIRE(::chmod((folder / "a").c_str(), 0664) == 0);
    REQUIRE(::chmod(folder.path().c_str(), 0777) == 0);
    CHECK(in_child([&] {
              if (!become_nobody()) return 1;
              replace_file(folder / "a", "later");
              return 0;
          }) == 0);
    CHECK(facts_of(folder / "a").st_gid == 65534);
    CHECK(mode_of(folder / "a") == 0644);
}

TEST_CASE("a replaced file keeps its access list") {
    const ScratchFolder folder;
    write_bytes(folder / "a", "earlier");
    // Version 2; owner rw-, user 12345 rw-, group r--, mask rw-, others ---.
    const unsigned char list[] = {2, 0,  0,   0,   1,   0,   6,  0, 255, 255, 255, 255, 2,   0,  6,
                                  0, 57, 48,  0,   0,   4,   0,  4, 0,   255, 255, 255, 255, 16, 0,
                                  6, 0,  255, 255, 255, 255, 32, 0, 0,   0,   255, 255, 255, 255};
    if (::setxattr((folder / "a").c_str(), "system.posix_acl_access", list, sizeof list, 0) != 0) return;
    replace_file(folder / "a", "later");
    unsigned char found[sizeof list] = {};
    CHECK(::getxattr((folder / "a").c_str(), "system.posix_acl_access", found, sizeof found) == sizeof found);
    CHECK(std::equal(std::begin(list), std::end(list), std::begin(found)));
}

TEST_CASE("a dangling link stays one and the file it asks for is made, through links and folders") {
    const ScratchFolder folder;
    fs::create_directory(folder / "elsewhere");
    fs::create_symlink("elsewhere/second", folder / "first");
    fs::create_symlink("real", folder / "elsewhere/second");
    replace_file(folder / "first", "text");
    CHECK(fs::is_symlink(folder / "first"));
    CHECK(fs::is_symlink(folder / "elsewhere/second"));
    CHECK(file_bytes(folder / "elsewhere/real") == "text");
    fs::create_symlink("round", folder / "round");
    CHECK_THROWS_AS(replace_file(folder / "round", "text"), ImageError);
    CHECK(folder.names() == std::vector<std::string>{"elsewhere", "first", "round"});
}

TEST_CASE("hidden names tell nothing of the process and never meet, in processes that are copies of each other too") {
    const ScratchFolder folder;
    std::set<std::string> names;
    for (int i = 0; i < 200; ++i) names.insert(ScratchFile(folder / "a").path().filename());
    CHECK(names.size() == 200);
    const int child = in_child([&] {
        for (int i = 0; i < 200; ++i)
            if (names.contains(ScratchFile(folder / "a").path().filename())) return 1;
        return 0;
    });
    CHECK(child == 0);
    CHECK(folder.names().empty());
}

TEST_CASE("a target that became a folder leaves the whole file beside it under a name that is said") {
    const ScratchFolder folder;
    ScratchFile file(folder / "a.exr");
    write_through(file, "all of it");
    fs::create_directory(folder / "a.exr");
    const std::string message = message_of_placing(file);
    CHECK(contains(message, "directory"));
    CHECK(contains(message, (folder / "a.kept.exr").string()));
    CHECK(file_bytes(folder / "a.kept.exr") == "all of it");

    ScratchFile second(folder / "a.exr");
    write_through(second, "later");
    CHECK(contains(message_of_placing(second), (folder / "a.kept-2.exr").string()));
    CHECK(file_bytes(folder / "a.kept.exr") == "all of it");
    CHECK(file_bytes(folder / "a.kept-2.exr") == "later");
    CHECK(folder.names() == std::vector<std::string>{"a.exr", "a.kept-2.exr", "a.kept.exr"});
}

TEST_CASE("a mounted file takes the bytes itself") {
    const ScratchFolder folder, outside;
    write_bytes(outside / "real", std::string(100, 'x'));
    write_bytes(folder / "a.png", "mount point");
    // Made before the fork: OpenImageIO starts threads.
    const std::vector<unsigned char> picture = encode(folder / "a.png", make_picture(2, 2), {}, {});
    const int failures = in_child([&] {
        if (::unshare(CLONE_NEWNS) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return 77;
        if (::mount((outside / "real").c_str(), (folder / "a.png").c_str(), nullptr, MS_BIND, nullptr) != 0) return 77;
        replace_file(folder / "a.png", picture);
        return file_bytes(folder / "a.png") == std::string(picture.begin(), picture.end()) && folder.names().size() == 1
                   ? 0
                   : 1;
    });
    if (failures == 77) return;  // mounts are not permitted here
    CHECK(failures == 0);
    CHECK(is_picture(outside / "real"));
    CHECK(read_picture(outside / "real").width() == 2);
    CHECK(file_bytes(folder / "a.png") == "mount point");
}

TEST_CASE(
    "in a folder that takes no changes any more the file that is there gets the bytes, a new one is kept elsewhere") {
    const ScratchFolder folder, temporary;
    const fs::path place = folder / "closing";
    fs::create_directory(place);
    write_bytes(place / "old.exr", "earlier and longer");
    for (const fs::path& path : {folder.path(), temporary.path(), place}) REQUIRE(::chmod(path.c_str(), 0777) == 0);
    REQUIRE(::chmod((place / "old.exr").c_str(), 0666) == 0);
    if (geteuid() == 0) REQUIRE(::chown(place.c_str(), 65534, 65534) == 0);
    const int failures = in_child([&] {
        ::setenv("TMPDIR", temporary.path().c_str(), 1);
        if (!become_nobody()) return 100;
        ScratchFile old(place / "old.exr"), fresh(place / "new.exr");
        write_through(old, "old");
        write_through(fresh, "new");
        ::chmod(place.c_str(), 0555);
        const bool all = message_of_placing(old).empty();
        const std::string message = message_of_placing(fresh);
        const bool said = contains(message, "denied") && contains(message, (temporary / "new.kept.exr").string());
        // From the beginning too: what may be written is written.
        replace_file(place / "old.exr", "again");
        ::chmod(place.c_str(), 0755);
        return !all + 2 * !said;
    });
    CHECK(failures == 0);
    CHECK(file_bytes(place / "old.exr") == "again");
    CHECK(file_bytes(temporary / "new.kept.exr") == "new");
    CHECK(temporary.names().size() == 1);
}

TEST_CASE("a file follows its folder when that is moved, and the place is said") {
    const ScratchFolder folder;
    fs::create_directory(folder / "before");
    ScratchFile file(folder / "before/a.exr");
    write_through(file, "all of it");
    fs::rename(folder / "before", folder / "after");
    CHECK(contains(message_of_placing(file), (folder / "after/a.exr").string()));
    CHECK(file_bytes(folder / "after/a.exr") == "all of it");
}

TEST_CASE("a folder that was emptied or made anew while a file was written gets it all the same") {
    const ScratchFolder folder;
    fs::create_directory(folder / "out");
    ScratchFile file(folder / "out/a.exr");
    write_through(file, "all of it");
    fs::remove_all(folder / "out");
    fs::create_directory(folder / "out");
    CHECK(message_of_placing(file) == "");
    CHECK(file_bytes(folder / "out/a.exr") == "all of it");
}

TEST_CASE("a picture whose folder is gone lies whole in the temporary folder") {
    const ScratchFolder folder, temporary;
    fs::create_directory(folder / "out");
    const int failures = in_child([&] {
        ::setenv("TMPDIR", temporary.path().c_str(), 1);
        ScratchFile file(folder / "out/a.exr");
        write_through(file, "all of it");
        fs::remove_all(folder / "out");
        const std::string message = message_of_placing(file);
        return contains(message, (temporary / "a.kept.exr").string()) ? 0 : 1;
    });
    CHECK(failures == 0);
    CHECK(file_bytes(temporary / "a.kept.exr") == "all of it");
}

TEST_CASE("a link that took the target's place meanwhile stays and what it leads to is written") {
    const ScratchFolder folder;
    ScratchFile file(folder / "a");
    write_through(file, "all of it");
    fs::create_symlink("real", folder / "a");
    CHECK(message_of_placing(file) == "");
    CHECK(fs::is_symlink(folder / "a"));
    CHECK(file_bytes(folder / "real") == "all of it");
    CHECK(folder.names() == std::vector<std::string>{"a", "real"});
}
