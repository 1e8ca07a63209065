// Shows progress on stderr: a line rewritten in place where that can be (status_line.h), and once, wherever it goes, a
// warning if the render will be long.
#pragma once

#include <string>

#include "src/parallel/progress.h"
#include "tools/cli/status_line.h"

namespace strata::tools::cli {

// "42 %, 3.1 M rays/s, 1 min 05 s left".
std::string progress_line(const parallel::Progress& progress);

// "12 s", "1 min 05 s", "2 h 03 min".
std::string duration_text(double seconds);

class ProgressPrinter {
  public:
    // quiet: neither line nor warning.
    explicit ProgressPrinter(bool quiet);

    // A callback for one render at a time; the printer must outlive it.
    parallel::ProgressCallback callback();

    void clear();

  private:
    void show(const parallel::Progress& progress);

    bool quiet_;
    StatusLine line_;
    bool warned_ = false;
};

// Renders predicted to take longer are announced, once the prediction rests on this much time.
inline constexpr double kLongRender_s = 600;
inline constexpr double kPredictionBasis_s = 2;

// Whether a render is predicted to be long.
bool predicted_long(const parallel::Progress& progress);

}  // namespace strata::tools::cli
