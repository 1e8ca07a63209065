#include "tools/animate/range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/scene/key_text.h"
#include "tools/errors.h"
#include "tools/scene_argument.h"

namespace strata::tools {

namespace {

constexpr int kLastFrame = 1'000'000'000;  // as shutter.frame

// Periods a frame: what passes of the motion's period in one.
std::optional<int> frames_to_repeat(double periods_a_frame) {
    // A whole number of periods, as exactly as decimal speeds and frame rates come out in double.
    constexpr double kRounding = 1e-9;
    if (periods_a_frame == 0.0 || !std::isfinite(periods_a_frame)) return std::nullopt;
    for (int frames = 1; frames <= kMostFrames; ++frames) {
        const double periods = frames * std::abs(periods_a_frame);
        if (periods > 0.5 && std::abs(periods - std::round(periods)) <= kRounding * periods) return frames;
    }
    return std::nullopt;
}

}  // namespace

FrameRange parse_frames(const std::string& text) {
    const auto dash = text.find('-', 1);
    const bool is_range = dash != std::string::npos;
    const char* allowed = "allowed: FRAME or FIRST-LAST, such as 0-249, from 0";
    FrameRange range;
    try {
        range.first = parse_integer("--frames", text.substr(0, dash), 0, kLastFrame);
        range.last = is_range ? parse_integer("--frames", text.substr(dash + 1), 0, kLastFrame) : range.first;
    } catch (const UsageError&) {
        throw UsageError(fmt::format("--frames {}: {}", scene::excerpt(text), allowed));
    }
    if (range.last < range.first)
        throw UsageError(fmt::format("--frames {}: ends before it begins, {}", text, allowed));
    if (range.count() > kMostFrames) {
        throw UsageError(fmt::format("--frames {}: {} frames, allowed: up to {}", text, range.count(), kMostFrames));
    }
    return range;
}

std::optional<int> loop_frames(const scene::Scene& scene) {
    const double fps = scene.shutter.fps;
    if (scene.image == scene::ImageKind::wheel) {
        return frames_to_repeat(scene.wheel.turns_per_s * scene.wheel.spokes / fps);
    }
    if (scene.image != scene::ImageKind::surface || scene.camera.keys.size() > 1) return std::nullopt;
    if (scene.surface.drift != glm::dvec3(0.0)) return std::nullopt;
    return frames_to_repeat(scene.surface.spin_deg_per_s / 360.0 / fps);
}

FrameRange default_frames(const scene::Scene& scene) {
    if (const auto frames = loop_frames(scene)) return {0, *frames - 1};
    if (scene.image == scene::ImageKind::surface && scene.camera.keys.size() > 1) {
        const double last = std::ceil(scene.camera.keys.back().time_s * scene.shutter.fps - 1e-9);
        if (last >= 1.0 && last < kMostFrames) return {0, static_cast<int>(last)};
    }
    throw UsageError(
        "--frames is needed: nothing in this scene tells where it ends (camera.keys do, and a surface.spin_deg_per_s "
        "or wheel.turns_per_s that loops in a whole number of frames)");
}

}  // namespace strata::tools
