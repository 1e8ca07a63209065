// What a render keeps of its work, as its job asks for.
#pragma once

#include <optional>

#include "tools/job/pass_journal.h"
#include "tools/job/still_journal.h"
#include "tools/job/work_journal.h"
#include "tools/render/job.h"

namespace strata::tools::render {

class RenderJournal {
  public:
    // Opens what an earlier process left, and says so. Throws UsageError for what is of another render
    // (work_journal.h). The job stays where it is.
    explicit RenderJournal(const Job& job);

    // One of the two is there, by the number of passes wanted.
    job::StillJournal* still() { return still_ ? &*still_ : nullptr; }
    strata::render::PassKeeper* passes() { return passes_ ? &*passes_ : nullptr; }

    void set_hidden_files(std::vector<std::filesystem::path> files) { work_.set_hidden_files(std::move(files)); }

    // When all is over: removes the journal of a picture that is in its files, and says of another one that it is
    // there.
    void end(bool is_whole);

  private:
    const Job& job_;
    job::WorkJournal work_;
    std::optional<job::StillJournal> still_;
    std::optional<job::PassJournal> passes_;
};

// NAME.EXT.journal beside the first output that is a file; empty where all are streams.
std::filesystem::path journal_path(const Job& job);

// All that has a part in the bits of a job's picture, and in what is kept of them.
journal::Identity identity_of(const Job& job);

}  // namespace strata::tools::render
