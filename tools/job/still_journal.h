// The journal of a picture of one pass, which goes into its files strip by strip.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/film/row_keeper.h"
#include "src/image/colour_out.h"
#include "src/image/encode.h"
#include "src/image/format.h"
#include "src/journal/kept_pixels.h"
#include "tools/job/kept_samples.h"
#include "tools/job/work_journal.h"

namespace strata::tools::job {

// Strips pass through here on their way to the encoders: what an earlier process kept is put in, and what is new goes
// into the journal, in the samples that the files store. Colour that is kept as codes alone is black in the film, and
// put right by the hook that the encoders call.
class StillJournal final : public film::RowKeeper {
  public:
    // `journal` outlives it.
    StillJournal(WorkJournal& journal, const film::StripLayout& layout, std::vector<SampleKind> kinds,
                 const image::ColourOut& colour);

    bool has(const film::Rect& part) const override { return kept_.has(part); }
    bool is_due() override { return journal_.is_due(); }
    void leaving(film::Film& strip, std::span<const film::Rect> fresh) override;
    void keep(std::span<const film::InWork> in_work) override;

    // Of a strip that has left: for an encoder of this format, and when all encoders have it.
    image::CodesHook codes_hook(image::Format format);
    void written(const film::Film& strip);

    // Of what is finished, when rendering is over.
    void finish();

    std::int64_t kept_pixels() const { return kept_.pixels(); }

  private:
    bool has_all_parts(const std::vector<journal::PixelPart>& parts) const;
    void restore(film::Film& strip, const journal::PixelRecord& record) const;
    std::optional<std::size_t> part_of(SampleKind kind) const;
    void overlay(SampleKind kind, std::span<unsigned char> codes) const;
    void append(const film::Film& film, std::span<const film::Rect> rects, bool use_codes);

    WorkJournal& journal_;
    journal::KeptPixels kept_;
    std::vector<SampleKind> kinds_;
    image::ColourOut colour_;
    std::size_t channel_values_ = 0;

    // Of the strip that is leaving.
    film::Rect window_;
    std::vector<film::Rect> fresh_;
    std::vector<journal::PixelRecord> restored_;
    std::vector<std::vector<unsigned char>> codes_;  // by kind: what the encoders made of the fresh rectangles
};

}  // namespace strata::tools::job
