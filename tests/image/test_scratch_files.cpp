#include "src/image/scratch_files.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "src/image/output_file.h"
#include "tests/image/scratch_folder.h"

using namespace strata;
namespace fs = std::filesystem;

namespace {

// Runs in a child process, which remove_scratch_files() makes unusable.
void in_child(const auto& body) {
    const pid_t child = fork();
    if (child == 0) {
        body();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(status == 0);
}

}  // namespace

TEST_CASE("the hidden files of outputs in the making are removed, finished and forgotten ones are not") {
    const ScratchFolder folder;
    in_child([&] {
        image::OutputFile done(folder.path() / "done.png");
        done.put_in_place();
        { const image::OutputFile given_up(folder.path() / "given-up.png"); }
        auto* first = new image::OutputFile(folder.path() / "first.png");
        auto* second = new image::OutputFile(folder.path() / "second.png");
        if (!fs::exists(first->hidden_path()) || !fs::exists(second->hidden_path())) _exit(1);
        image::remove_scratch_files();
        _exit(0);  // what is destroyed after that waits for the end
    });
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        CHECK(entry.path().filename() == "done.png");
        ++files;
    }
    CHECK(files == 1);
}

TEST_CASE("a folder that was remembered before its files goes too") {
    const ScratchFolder folder;
    const fs::path inner = folder.path() / "inner", file = inner / "file";
    in_child([&] {
        fs::create_directory(inner);
        std::ofstream(file) << "text";
        image::remember_scratch_file(inner.c_str());
        image::remember_scratch_file(file.c_str());
        image::remove_scratch_files();
        _exit(0);  // what is destroyed after that waits for the end
    });
    CHECK(!fs::exists(inner));
}

TEST_CASE("more files than are remembered do no harm") {
    const std::string path = "/nonexistent/file";
    for (int i = 0; i < 2000; ++i) image::remember_scratch_file(path.c_str());
    for (int i = 0; i < 2000; ++i) image::forget_scratch_file(path.c_str());
    const ScratchFolder folder;
    image::OutputFile(folder.path() / "a.png").put_in_place();
    CHECK(fs::exists(folder.path() / "a.png"));
}
