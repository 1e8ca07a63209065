// The options of a render, checked, in the words of src/render.
#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <stop_token>

#include "src/integrate/surface_image.h"
#include "src/parallel/cancel.h"
#include "src/render/progressive.h"
#include "src/scene/scene.h"
#include "src/strata.h"

namespace strata {

// Lives as long as its render, whose options refer to it.
class RenderSetting {
  public:
    // Throws Error for options out of range and for a scene that cannot be rendered.
    RenderSetting(const Scene& scene, const RenderOptions& options);
    RenderSetting(const RenderSetting&) = delete;
    RenderSetting& operator=(const RenderSetting&) = delete;

    const scene::Scene& scene() const { return scene_; }
    const film::Rect& window() const { return window_; }
    const render::PassGoal& goal() const { return goal_; }
    integrate::Tracer tracer() const { return tracer_; }
    const render::RenderOptions& options() const { return options_; }

    void cancel() { cancel_.request(); }

    // What the caller's on_progress threw, kept while the render comes to its end.
    bool callback_failed() const { return callback_failure_ != nullptr; }
    void rethrow_of_callback() const {
        if (callback_failure_) std::rethrow_exception(callback_failure_);
    }

  private:
    void take_progress(const std::function<void(const Progress&)>& on_progress);

    scene::Scene scene_;
    film::Rect window_;
    render::PassGoal goal_;
    integrate::Tracer tracer_ = integrate::Tracer::fast;
    render::RenderOptions options_;
    parallel::CancelToken cancel_;
    std::exception_ptr callback_failure_;
    std::optional<std::stop_callback<std::function<void()>>> stop_;  // the last: it may call at once
};

RenderReport report_of(const render::ProgressiveResult& result);

}  // namespace strata
