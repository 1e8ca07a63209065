// The journal of a picture of several passes, which is held whole.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/journal/kept_pixels.h"
#include "src/render/pass_keeper.h"
#include "tools/job/work_journal.h"

namespace strata::tools::job {

// Holds the sums of the passes that are whole, the last of them where it waits for the other of its pair, and what is
// finished of the pass in work. Sums change with every pass: when an interval ends in another pass than the one before,
// the journal is written anew and takes the place of the earlier one; within a pass what is new is appended.
class PassJournal final : public strata::render::PassKeeper {
  public:
    // `journal` outlives it.
    PassJournal(WorkJournal& journal, const film::Rect& window);

    std::optional<strata::render::PassesSoFar> restore(const film::Rect& window,
                                                       const film::FilmExtras& extras) override;
    void begin_pass(const strata::render::PassesSoFar& before, const film::Film& pass) override;
    void stop() override;

    bool has(const film::Rect& part) const override;
    bool is_due() override { return journal_.is_due(); }
    void leaving(film::Film& strip, std::span<const film::Rect> fresh) override;
    void keep(std::span<const film::InWork> in_work) override;

    // How many passes an earlier process finished.
    int kept_passes() const { return kept_passes_; }

  private:
    std::optional<strata::render::PassesSoFar> restore_sums(const film::FilmExtras& extras) const;
    void restore_strip(const journal::KeptPixels& kept, film::Film& strip) const;
    bool restore_last(film::Film& film) const;

    WorkJournal& journal_;
    film::StripLayout layout_;
    journal::KeptPixels kept_;  // of the pass that an earlier process had in work
    int kept_passes_ = 0;       // whole before that
    int written_passes_ = -1;   // sums of so many are in the file; -1: no file

    const strata::render::PassesSoFar* before_ = nullptr;
    const film::Film* pass_ = nullptr;
    int number_ = 0;                   // of the pass in work
    std::vector<film::Rect> pending_;  // in the film of the pass, and not in the file
};

}  // namespace strata::tools::job
