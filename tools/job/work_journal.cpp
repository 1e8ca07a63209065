#include "tools/job/work_journal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "src/journal/journal_error.h"
#include "src/journal/pixel_record.h"
#include "tools/cli/errors.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::job {
namespace fs = std::filesystem;
namespace {

constexpr double kBeginsAfter = 1.0 / 6;  // of the interval
constexpr double kMostShare = 0.01;       // of the time

std::uint32_t number_of(JournalRecord type) { return static_cast<std::uint32_t>(type); }

}  // namespace

WorkJournal::WorkJournal(fs::path path, journal::Identity identity, const JournalOptions& options, bool quiet)
    : path_(std::move(path)),
      identity_(std::move(identity)),
      interval_s_(options.interval_s),
      threads_(options.threads),
      quiet_(quiet),
      due_s_(options.interval_s * kBeginsAfter),
      is_given_up_(path_.empty() || options.is_unwanted) {
    if (!is_given_up_) open(options);
}

void WorkJournal::open(const JournalOptions& options) {
    try {
        file_ = journal::File::open(path_);
    } catch (const journal::JournalInUse& error) {
        throw cli::UsageError(fmt::format("{}; allowed: another output, or --no-journal", error.what()));
    } catch (const journal::JournalError& error) {
        return give_up(error.what());
    }
    if (!file_) return;
    if (options.restart) {
        file_->remove();
        return file_.reset();
    }
    try {
        read_records();
    } catch (const journal::JournalError&) {  // of a program that wrote other records
        throw cli::UsageError(
            fmt::format("\"{}\" cannot be read; allowed: --restart, which throws it away", path_.string()));
    }
    if (!resumed_) return;
    due_s_ = interval_s_;
}

// A journal without its first record has nothing to lose.
void WorkJournal::read_records() {
    for (const journal::RecordPlace& place : file_->places()) {
        if (place.type != number_of(JournalRecord::identity)) break;
        const std::vector<unsigned char> payload = file_->read(place);
        journal::PayloadReader reader(payload);
        const std::vector<std::string> lines = journal::differences(journal::Identity::read(reader), identity_);
        if (!lines.empty()) {
            throw cli::UsageError(fmt::format(
                "\"{}\" keeps the unfinished work of another render: {}; allowed: the same settings, --restart, which "
                "throws it away, or --no-journal",
                path_.string(), fmt::join(lines, "; ")));
        }
        resumed_ = true;
        break;
    }
    if (!resumed_) {
        file_->remove();
        return file_.reset();
    }
    for (const journal::RecordPlace& place : file_->places()) {
        if (place.type != number_of(JournalRecord::seconds)) continue;
        const std::vector<unsigned char> payload = file_->read(place);
        earlier_s_ = journal::PayloadReader(payload).take<double>();
    }
    remove_hidden_files();
}

void WorkJournal::find_pixels(int film, journal::KeptPixels& kept) const {
    for (const journal::RecordPlace& place : file_->places()) {
        if (place.type != number_of(JournalRecord::pixels)) continue;
        const auto start = file_->read_start(place, journal::kPixelHeadStart);
        const auto bytes = file_->read_start(place, journal::pixel_head_bytes(start));
        journal::PayloadReader reader(bytes);
        const journal::PixelHead head = journal::read_pixel_head(reader);
        if (head.film == static_cast<std::uint32_t>(film)) kept.add(place, head.rects);
    }
}

// Whoever made them is dead, since the journal is ours. Nothing but what a render calls its hidden files is touched.
void WorkJournal::remove_hidden_files() const {
    for (const journal::RecordPlace& place : file_->places()) {
        if (place.type != number_of(JournalRecord::files)) continue;
        const std::vector<unsigned char> payload = file_->read(place);
        journal::PayloadReader reader(payload);
        while (!reader.is_empty()) {
            const fs::path path = reader.take_text();
            std::error_code error;
            if (path.filename().string().starts_with(".strata-")) fs::remove(path, error);
        }
    }
}

void WorkJournal::set_hidden_files(std::vector<fs::path> files) {
    hidden_files_ = std::move(files);
    if (file_) append(JournalRecord::files, names_of_files().bytes());
}

journal::PayloadWriter WorkJournal::names_of_files() const {
    journal::PayloadWriter names;
    for (const fs::path& path : hidden_files_) names.put_text(fs::absolute(path).string());
    return names;
}

void WorkJournal::write_head(journal::File& file) const {
    journal::PayloadWriter identity;
    identity_.write(identity);
    const journal::PayloadWriter files = names_of_files();
    const journal::Bytes head[] = {identity.bytes()}, names[] = {files.bytes()};
    file.append(number_of(JournalRecord::identity), head);
    file.append(number_of(JournalRecord::files), names);
}

void WorkJournal::begin() {
    if (file_ || is_given_up_) return;
    try {
        file_ = journal::File::create(path_);
        write_head(*file_);
    } catch (const journal::JournalError& error) {
        give_up(error.what());
    }
}

void WorkJournal::append(JournalRecord type, journal::Bytes payload) {
    if (!is_open()) return;
    try {
        file_->append(number_of(type), {&payload, 1});
    } catch (const journal::JournalError& error) {
        give_up(error.what());
    }
}

void WorkJournal::sync(double cpu_seconds) {
    journal::PayloadWriter seconds;
    seconds.put(earlier_s_ + now_s());
    append(JournalRecord::seconds, seconds.bytes());
    try {
        if (is_open()) file_->sync();
    } catch (const journal::JournalError& error) {
        give_up(error.what());
    }
    due_s_ = now_s() + std::max(interval_s_ * (1 - kBeginsAfter), cpu_seconds / (kMostShare * threads_));
}

void WorkJournal::swap_in(journal::File file) {
    file.sync();
    file.rename_to(path_);
    file.sync();
    file_ = std::move(file);
}

// What is there stays: it can be gone on from.
void WorkJournal::give_up(const std::string& reason) {
    is_given_up_ = true;
    if (!quiet_) cli::print_error(fmt::format("warning: {}; the render goes on without a journal", reason));
}

void WorkJournal::remove() {
    if (!file_) return;
    try {
        file_->remove();
    } catch (const journal::JournalError& error) {
        give_up(error.what());
    }
    file_.reset();
}

std::string WorkJournal::kept_line() const {
    if (!file_) return "";
    return fmt::format("journal  {} keeps what is finished; the same command goes on from it\n", path_.string());
}

}  // namespace strata::tools::job
