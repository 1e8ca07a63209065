#include "tools/job/batch_progress.h"

namespace strata::tools::job {

parallel::ProgressCallback BatchProgress::next(double weight) {
    if (!start_) start_ = std::chrono::steady_clock::now();
    done_ += weight_;
    rays_ += current_rays_;
    weight_ = weight;
    current_rays_ = 0;
    return [this](const parallel::Progress& progress) { advance(progress); };
}

void BatchProgress::advance(const parallel::Progress& progress) {
    current_rays_ = progress.rays;
    if (!show_) return;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - *start_).count();
    show_({.fraction = total_ > 0 ? (done_ + weight_ * progress.fraction) / total_ : 1,
           .rays = rays_ + current_rays_,
           .seconds = seconds});
}

}  // namespace strata::tools::job
