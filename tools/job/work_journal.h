// The journal of a render (src/journal): where it lies, when it is written, and what is told of it.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/journal/file.h"
#include "src/journal/identity.h"
#include "src/journal/kept_pixels.h"
#include "src/journal/payload.h"

namespace strata::tools::job {

struct JournalOptions {
    bool is_unwanted = false;
    bool restart = false;    // an earlier journal is thrown away
    double interval_s = 30;  // between two times that it is written and synchronised to the disk
    int threads = 1;         // that render
};

// What the records of all journals of renders are.
enum class JournalRecord : std::uint32_t {
    identity = 1,  // the first
    files = 2,     // hidden files of the process that wrote it
    pixels = 3,    // pixel_record.h
    seconds = 4,   // how long was rendered, all processes together
    passes = 5,    // numbers of the passes that are added up
    sums = 6,      // pixel_record.h, of their sums
};

// A render begins its journal after a sixth of the interval: what takes less leaves none and pays nothing, and is what
// is lost at most beside the interval's other five sixths. A journal that cannot be written is told once and given up;
// the render goes on.
class WorkJournal {
  public:
    // Opens the journal at `path`, empty for none, if there is one. Throws UsageError where it is of other work, naming
    // what differs, and where another process has it; a file that is no journal is left alone and told.
    WorkJournal(std::filesystem::path path, journal::Identity identity, const JournalOptions& options, bool quiet);

    // What an earlier process left. File and records stay readable until replace().
    bool is_resumed() const { return resumed_; }
    const journal::File& file() const { return *file_; }
    double earlier_seconds() const { return earlier_s_; }

    // Adds the records of finished pixels of the film of this number (PixelHead::film) to `kept`.
    void find_pixels(int film, journal::KeptPixels& kept) const;

    // Names of hidden files that this process makes, to be removed by whoever goes on from this journal if this process
    // cannot.
    void set_hidden_files(std::vector<std::filesystem::path> files);

    // Whether the interval is over. From any thread.
    bool is_due() const { return !is_given_up_ && now_s() >= due_s_; }

    // Whether records can be appended: the journal has been begun and not given up.
    bool is_open() const { return file_.has_value() && !is_given_up_; }

    // Makes the file, if it is not there.
    void begin();

    void append(JournalRecord type, journal::Bytes payload);

    // At the end of what an interval brought: waits for the disk, and begins the next. It is prolonged where that
    // took more than a hundredth of what all threads do in it.
    void sync(double cpu_seconds);

    // Lets append(file) write to the journal that is open.
    template <class Append>
    void change(const Append& append);

    // Writes the journal anew under another name, by fill(), and puts it in place of the one that is there.
    template <class Fill>
    void replace(const Fill& fill);

    // The picture is whole: there is nothing to go on from any more.
    void remove();

    // A line that tells where to go on from, or nothing.
    std::string kept_line() const;

  private:
    void open(const JournalOptions& options);
    void read_records();
    void remove_hidden_files() const;
    journal::PayloadWriter names_of_files() const;
    void write_head(journal::File& file) const;
    void give_up(const std::string& reason);
    double now_s() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    void swap_in(journal::File file);

    std::filesystem::path path_;
    journal::Identity identity_;
    double interval_s_;
    int threads_;
    bool quiet_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::atomic<double> due_s_;
    std::atomic<bool> is_given_up_{false};
    bool resumed_ = false;
    double earlier_s_ = 0;
    std::vector<std::filesystem::path> hidden_files_;
    std::optional<journal::File> file_;
};

template <class Append>
void WorkJournal::change(const Append& append) {
    if (!is_open()) return;
    try {
        append(*file_);
    } catch (const std::exception& error) {
        give_up(error.what());
    }
}

template <class Fill>
void WorkJournal::replace(const Fill& fill) {
    if (is_given_up_) return;
    try {
        const std::filesystem::path path = path_.string() + ".new";
        std::error_code error;
        std::filesystem::remove(path, error);
        journal::File next = journal::File::create(path);
        write_head(next);
        fill(next);
        swap_in(std::move(next));
    } catch (const std::exception& error) {
        give_up(error.what());
    }
}

}  // namespace strata::tools::job
