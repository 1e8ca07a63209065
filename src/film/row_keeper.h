// Finished pixels that outlive the process which rendered them: what a stream of rows (row_stream.h) needs of whoever
// keeps them.
#pragma once

#include <span>
#include <vector>

#include "src/film/film.h"

namespace strata::film {

// A film of which some rectangles are finished and were not handed over before.
struct InWork {
    const Film* film;
    std::vector<Rect> fresh;
};

// What cannot be kept is no error: the picture is finished without. Films are strips of the picture, or smaller; all
// rectangles lie within a strip.
class RowKeeper {
  public:
    virtual ~RowKeeper() = default;

    // Whether these pixels were kept by an earlier process, so that they need not be rendered. From any thread.
    virtual bool has(const Rect& part) const = 0;

    // Whether what is finished of strips in work should be handed over now. From any thread.
    virtual bool is_due() = 0;

    // The next two are called by one thread at a time.

    // Puts what an earlier process kept of a strip into it, marked as finished, before it goes where strips go; `fresh`
    // is what was finished since the strip was last handed over. What it throws, as it does where kept pixels cannot be
    // read any more, counts as thrown by the sink.
    virtual void leaving(Film& strip, std::span<const Rect> fresh) = 0;

    // Hands over what is finished of strips in work, and does not throw. Their other pixels are being written to by
    // other threads.
    virtual void keep(std::span<const InWork> in_work) = 0;
};

}  // namespace strata::film
