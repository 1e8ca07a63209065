// Pictures made one after the other: progress over all of them, stopping, and files of which each fails alone. What is
// finished when a batch is stopped is kept, and the same command goes on from there: it asks first which files are
// there already (already_there.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "src/parallel/cancel.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/job/batch_progress.h"
#include "tools/job/picture_job.h"

namespace strata::tools::job {

class Batch {
  public:
    // threads: 0 for as many as machine and container give. quiet: neither progress nor warnings.
    Batch(int threads, bool quiet, const parallel::CancelToken& cancel);

    // What will be rendered, for the progress: all of it before the first render. cost: of a ray, relative to others.
    void expect(const PictureJob& job, double cost = 1) { progress_.expect(cost * job.expected_rays()); }

    // Nothing if it was stopped.
    std::optional<RenderedPicture> render(const PictureJob& job, double cost = 1);

    // Calls write(path) for each file of a picture; one that fails is told. Whether any was written.
    template <class Write>
    bool write(const std::vector<std::filesystem::path>& files, const Write& write);

    bool is_stopped() const { return cancel_.requested(); }

    // Of two pictures in a row no file could be written: nor could those of the next.
    bool is_failing() const { return failed_in_a_row_ >= 2; }

    bool all_written() const { return all_written_; }

    // Takes the line of progress away, for what is to be told.
    void clear_progress() { printer_.clear(); }

    // That rays were not settled, if there were any, in all renders so far.
    void warn_of_unresolved() const;

  private:
    const int threads_;
    const bool quiet_;
    const parallel::CancelToken& cancel_;
    cli::ProgressPrinter printer_;
    BatchProgress progress_;
    std::uint64_t unresolved_rays_ = 0;
    int failed_in_a_row_ = 0;
    bool all_written_ = true;
};

template <class Write>
bool Batch::write(const std::vector<std::filesystem::path>& files, const Write& write) {
    bool any = false;
    for (const std::filesystem::path& path : files) {
        const bool is_there = cli::is_written(path, [&] { write(path); });
        any |= is_there;
        all_written_ &= is_there;
    }
    failed_in_a_row_ = any ? 0 : failed_in_a_row_ + 1;
    return any;
}

// That so many rays were not settled, unless none was or quiet.
void warn_of_unresolved(std::uint64_t rays, bool quiet);

}  // namespace strata::tools::job
