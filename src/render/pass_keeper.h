// Passes that outlive the process which rendered them: what render_progressively() needs of whoever keeps them.
#pragma once

#include <optional>

#include "src/film/film.h"
#include "src/film/row_keeper.h"
#include "src/render/error_estimate.h"
#include "src/render/pass_sum.h"

namespace strata::render {

// All that the next pass builds on.
struct PassesSoFar {
    int passes = 0;  // whole ones
    PassSum sum;     // of them; empty while there is one
    ErrorMeter meter;
    film::Film last;     // the last of them: where their number is odd, it is the first of a pair
    double seconds = 0;  // rendered by earlier processes
    double longest_pass_s = 0;
    std::optional<int> predicted_passes;
    double predicted_seconds = 0;
};

class PassKeeper : public film::RowKeeper {
  public:
    // What an earlier process had added up, its `last` only where their number is odd; nothing: none. `window` and
    // `extras` are those of the films.
    virtual std::optional<PassesSoFar> restore(const film::Rect& window, const film::FilmExtras& extras) = 0;

    // The pass of this number begins; its strips go to `pass` after they have left. Both stay where they are, and as
    // they are but for that, until the next pass begins or the render ends.
    virtual void begin_pass(const PassesSoFar& before, const film::Film& pass) = 0;

    // The render is being stopped: all that is finished is to be kept.
    virtual void stop() = 0;
};

}  // namespace strata::render
