#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <random>

#include "src/journal/file.h"
#include "src/journal/journal_error.h"
#include "tests/image/scratch_folder.h"
#include "tests/journal/journal_bytes.h"

namespace fs = std::filesystem;
using namespace strata::journal;

namespace {

void append(File& file, const Block& payload) {
    const Bytes part(payload);
    file.append(3, {&part, 1});
}

std::vector<Block> payloads_of(const File& file) {
    std::vector<Block> payloads;
    for (const RecordPlace& place : file.places()) payloads.push_back(file.read(place));
    return payloads;
}

}  // namespace

TEST_CASE("records are found again, and others go behind them") {
    const ScratchFolder folder;
    std::mt19937_64 random(5);
    std::vector<Block> written;
    for (int times = 0; times < 4; ++times) {
        std::optional<File> file = times == 0 ? File::create(folder / "j") : File::open(folder / "j");
        REQUIRE(file);
        CHECK(payloads_of(*file) == written);
        for (int i = 0; i < 3; ++i) {
            written.push_back(random_block(random, random() % 5000));
            // The parts of a payload are one behind the other.
            const Bytes all(written.back());
            const std::vector<Bytes> parts{all.first(all.size() / 3), all.subspan(all.size() / 3)};
            file->append(static_cast<std::uint32_t>(i), parts);
        }
        file->sync();
        CHECK(file->bytes() == static_cast<std::int64_t>(fs::file_size(folder / "j")));
    }
}

TEST_CASE("a torn tail is cut off, so that what is appended next is found") {
    const ScratchFolder folder;
    {
        File file = File::create(folder / "j");
        append(file, Block(100, 1));
        append(file, Block(200, 2));
    }
    fs::resize_file(folder / "j", fs::file_size(folder / "j") - 7);
    {
        std::optional<File> file = File::open(folder / "j");
        CHECK(payloads_of(*file) == std::vector<Block>{Block(100, 1)});
        append(*file, Block(300, 3));
    }
    CHECK(payloads_of(*File::open(folder / "j")) == std::vector<Block>{Block(100, 1), Block(300, 3)});
}

TEST_CASE("a journal is open once at a time") {
    const ScratchFolder folder;
    {
        File file = File::create(folder / "j");
        CHECK_THROWS_AS(File::open(folder / "j"), JournalInUse);
        CHECK_THROWS_AS(File::create(folder / "j"), JournalError);
    }
    CHECK(File::open(folder / "j"));
    CHECK(!File::open(folder / "none"));
}

TEST_CASE("one whose head never reached the disk is begun anew, and a foreign file is left alone") {
    const ScratchFolder folder;
    for (const std::string& text : {std::string(), std::string("STRATA"), std::string(5000, '\0')}) {
        std::ofstream(folder / "j") << text;
        std::optional<File> file = File::open(folder / "j");
        REQUIRE(file);
        CHECK(file->places().empty());
        append(*file, Block(9, 9));
        file.reset();
        CHECK(payloads_of(*File::open(folder / "j")) == std::vector<Block>{Block(9, 9)});
    }
    for (const std::string& text :
         {std::string("Dear reader, this is no journal."), std::string("Dear"), std::string("S.")}) {
        std::ofstream(folder / "letter") << text;
        CHECK_THROWS_WITH_AS(File::open(folder / "letter"), doctest::Contains("is no journal"), JournalError);
        CHECK(fs::file_size(folder / "letter") == text.size());
    }
}

TEST_CASE("what cannot be appended leaves the records that are there") {
    const ScratchFolder folder;
    // Files may have 1000 bytes; the signal that tells is taken as an error of the write.
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        File file = File::create(folder / "j");
        append(file, Block(100, 1));
        bool failed = false;
        try {
            append(file, Block(5000, 2));
        } catch (const JournalError&) {
            failed = true;
        }
        append(file, Block(100, 3));
        ::_exit(failed ? 0 : 1);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(payloads_of(*File::open(folder / "j")) == std::vector<Block>{Block(100, 1), Block(100, 3)});
}

TEST_CASE("a journal takes another one's name at once, and that one's owner keeps reading it") {
    const ScratchFolder folder;
    File old = File::create(folder / "j");
    append(old, Block(10, 1));
    File next = File::create(folder / "j.new");
    append(next, Block(10, 2));
    next.rename_to(folder / "j");
    CHECK(!fs::exists(folder / "j.new"));
    CHECK_THROWS_AS(File::open(folder / "j"), JournalInUse);
    next = File::create(folder / "other");
    CHECK(payloads_of(*File::open(folder / "j")) == std::vector<Block>{Block(10, 2)});
}
