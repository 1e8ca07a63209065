#include <doctest/doctest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/output_file.h"
#include "src/image/read.h"
#include "src/image/write.h"
#include "tests/image/scratch_folder.h"

using namespace strata::image;
namespace fs = std::filesystem;

namespace {

std::string check_error(const fs::path& path) {
    try {
        check_writable(path);
    } catch (const ImageError& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The exit code of `body` run in a child process, so that limits and identity end with it.
template <class Body>
int in_child(Body body) {
    const pid_t child = fork();
    if (child == 0) _exit(body());
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    return WEXITSTATUS(status);
}

constexpr rlim_t kLimit = 4096;

bool limit_file_size() {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{kLimit, kLimit};
    return setrlimit(RLIMIT_FSIZE, &limit) == 0;
}

Picture noisy_picture(int width, int height) {
    Picture picture = make_picture(width, height);
    std::uint32_t state = 1;
    for (float& value : picture.rgb)
        value = static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f;
    return picture;
}

}  // namespace

TEST_CASE("the format follows the extension in either case") {
    CHECK(format_of("a.exr") == Format::exr);
    CHECK(format_of("a.b/c.PNG") == Format::png);
    CHECK(format_of("a.TiF") == Format::tiff);
    CHECK(format_of("a.tiff") == Format::tiff);
    CHECK(format_of("a.jpg") == Format::jpeg);
    CHECK(format_of("a.JPEG") == Format::jpeg);
}

TEST_CASE("an unknown extension is refused with the list of known ones") {
    for (const char* name : {"a.gif", "a", "", ".exr", "a.exr.", "a.exr~", "png", "a.png/", "a.pn\xc3\xa9"}) {
        CAPTURE(name);
        const std::string message = check_error(name);
        CHECK(contains(message, ".exr, .png, .tif, .tiff, .jpg, .jpeg"));
    }
}

TEST_CASE("a writable place passes and stays as it was") {
    const ScratchFolder folder;
    CHECK(check_error(folder / "a.exr") == "");
    CHECK(folder.names().empty());
    write_bytes(folder / "a.exr", "earlier");
    CHECK(check_error(folder / "a.exr") == "");
    CHECK(file_bytes(folder / "a.exr") == "earlier");
    CHECK(folder.names().size() == 1);
}

TEST_CASE("places that cannot take the file are named with the reason") {
    const ScratchFolder folder;
    fs::create_directory(folder / "folder.exr");
    write_bytes(folder / "file", "");
    REQUIRE(mknod((folder / "socket.png").c_str(), S_IFSOCK | 0600, 0) == 0);
    CHECK(contains(check_error(folder / "missing/a.exr"), "does not exist"));
    CHECK(contains(check_error(folder / "missing/a.exr"), (folder / "missing").string()));
    CHECK(contains(check_error(folder / "file/a.exr"), "ot a folder"));
    CHECK(contains(check_error(folder / "folder.exr"), "it is a folder"));
    CHECK(contains(check_error(folder / "socket.png"), "not a regular file"));
    CHECK(contains(check_error(folder / (std::string(300, 'n') + ".exr")), "too long"));
    CHECK(contains(check_error("/proc/a.exr"), "cannot write"));
}

TEST_CASE("a pipe, a device and standard output take pictures; nothing is made beside them") {
    const ScratchFolder folder;
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK(check_error(folder / "pipe").empty());
    CHECK(check_error("png:" + (folder / "pipe").string()).empty());
    CHECK(check_error("/dev/null").empty());
    CHECK(format_of(folder / "pipe") == Format::exr);
    CHECK(format_of("png:" + (folder / "pipe").string()) == Format::png);
    CHECK(contains(check_error("png:" + (folder / "none").string()), "cannot tell the picture format"));
    { const OutputFile file(folder / "pipe"); }
    CHECK(folder.names().size() == 1);
}

TEST_CASE("a folder or file without write permission is refused") {
    const ScratchFolder folder;
    fs::create_directory(folder / "closed");
    write_bytes(folder / "closed/a.exr", "earlier");
    write_bytes(folder / "b.exr", "earlier");
    REQUIRE(chmod(folder.path().c_str(), 0777) == 0);
    REQUIRE(chmod((folder / "b.exr").c_str(), 0444) == 0);
    REQUIRE(chmod((folder / "closed").c_str(), 0555) == 0);
    const int failures = in_child([&] {
        // Permissions do not bind root.
        if (geteuid() == 0 && setuid(65534) != 0) return 100;
        return !contains(check_error(folder / "closed/new.exr"), "Permission denied") +
               2 * !contains(check_error(folder / "b.exr"), "Permission denied") +
               4 * (check_error(folder / "c.exr") != "");
    });
    CHECK(failures == 0);
    chmod((folder / "closed").c_str(), 0755);
}

TEST_CASE("a file at the name's length limit can be written") {
    const ScratchFolder folder;
    const auto path = folder / (std::string(251, 'n') + ".png");
    CHECK(check_error(path) == "");
    write_picture(path, make_picture(1, 1));
    CHECK(is_picture(path));
}

TEST_CASE("a full disk is an error, the earlier file stays and nothing else is left") {
    const ScratchFolder folder;
    for (const char* name : {"a.exr", "a.png", "a.tif", "a.jpg"}) {
        CAPTURE(name);
        write_bytes(folder / name, "earlier");
        const Picture picture = noisy_picture(200, 100);
        const int failures = in_child([&] {
            if (!limit_file_size()) return 100;
            try {
                write_picture(folder / name, picture);
            } catch (const ImageError& error) {
                return !contains(error.what(), "too large") + 2 * !contains(error.what(), (folder / name).string());
            }
            return 50;
        });
        CHECK(failures == 0);
        CHECK(file_bytes(folder / name) == "earlier");
    }
    CHECK(folder.names().size() == 4);
}

TEST_CASE("a file is replaced as a whole, a reader that holds the earlier one keeps it") {
    const ScratchFolder folder;
    const auto path = folder / "a.bin";
    write_bytes(path, "earlier");
    std::ifstream reader(path, std::ios::binary);
    const std::string later(100'000, 'x');
    replace_file(path, {reinterpret_cast<const unsigned char*>(later.data()), later.size()});
    CHECK(file_bytes(path) == later);
    CHECK(std::string(std::istreambuf_iterator<char>(reader), {}) == "earlier");
    CHECK(folder.names().size() == 1);
}

TEST_CASE("several threads writing one name leave one whole file") {
    const ScratchFolder folder;
    const auto path = folder / "a.bin";
    std::vector<std::thread> threads;
    for (char letter = 'a'; letter < 'e'; ++letter)
        threads.emplace_back([&path, letter] {
            const std::vector<unsigned char> bytes(50'000, static_cast<unsigned char>(letter));
            for (int round = 0; round < 20; ++round) replace_file(path, bytes);
        });
    for (std::thread& thread : threads) thread.join();
    const std::string bytes = file_bytes(path);
    CHECK(bytes == std::string(50'000, bytes.empty() ? '?' : bytes[0]));
    CHECK(folder.names().size() == 1);
}

TEST_CASE("a symbolic link stays one and its target is replaced") {
    const ScratchFolder folder;
    fs::create_directory(folder / "elsewhere");
    write_bytes(folder / "elsewhere/real.png", "earlier");
    fs::create_symlink("elsewhere/real.png", folder / "link.png");
    CHECK(check_error(folder / "link.png") == "");
    write_picture(folder / "link.png", make_picture(2, 2));
    CHECK(fs::is_symlink(folder / "link.png"));
    CHECK(is_picture(folder / "elsewhere/real.png"));
    CHECK(folder.names().size() == 2);
}

TEST_CASE("paths with spaces, quotes and letters beyond ASCII work in every format") {
    const ScratchFolder folder;
    const fs::path place = folder / "m\xc3\xa9moire \xe5\xb1\xb1 %d 'x'";
    fs::create_directory(place);
    for (const char* extension : {".exr", ".png", ".tif", ".jpg"}) {
        const fs::path path = place / (std::string("\xc3\xbc b #1.v2") + extension);
        CHECK(check_error(path) == "");
        Metadata metadata;
        metadata.set(kSceneKey, "x = 1");
        write_picture(path, make_picture(5, 4), metadata);
        CHECK(read_picture(path).width() == 5);
        CHECK(read_metadata(path, kSceneKey) == "x = 1");
    }
}

TEST_CASE("a file may be longer than 4 GB: what is written far behind is read there") {
    const ScratchFolder folder;
    constexpr std::int64_t kFar = (std::int64_t{5} << 30) + 3;
    {
        OutputFile file(folder / "large.exr");
        const std::vector<unsigned char> bytes{1, 2, 3, 4};
        file.write_at(kFar, bytes);
        std::vector<unsigned char> back(6, 9);
        CHECK(file.read_at(kFar, back) == 4);
        CHECK(back == std::vector<unsigned char>{1, 2, 3, 4, 9, 9});
        CHECK(file.read_at(std::int64_t{1} << 32, back) == 6);
        CHECK(back == std::vector<unsigned char>(6, 0));
        CHECK(fs::file_size(*file.scratch_path()) == static_cast<std::uintmax_t>(kFar) + 4);
    }
    CHECK(fs::is_empty(folder.path()));
}
