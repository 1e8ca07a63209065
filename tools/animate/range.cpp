#include "tools/animate/range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/scene/key_text.h"
#include "src/scene/needs.h"
#include "tools/cli/errors.h"
#include "tools/cli/scene_argument.h"

namespace strata::tools::animate {

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

// "12", "0-249" or "0-100x2".
struct Part {
    int first = 0, last = 0, step = 1;
};

Part parse_part(const std::string& origin, const std::string& all, const std::string& text) {
    const char* allowed =
        "allowed: NUMBER, FIRST-LAST or FIRST-LASTxSTEP, such as 0-249 or 0-100x2, from 0; several with ','";
    const auto dash = text.find('-', 1);
    const bool is_range = dash != std::string::npos;
    const auto times = is_range ? text.find('x', dash) : std::string::npos;
    Part part;
    try {
        part.first = cli::parse_integer(origin, text.substr(0, dash), 0, kLastFrame);
        part.last =
            is_range ? cli::parse_integer(origin, text.substr(dash + 1, times - dash - 1), 0, kLastFrame) : part.first;
        if (times != std::string::npos) part.step = cli::parse_integer(origin, text.substr(times + 1), 1, kLastFrame);
    } catch (const cli::UsageError&) {
        throw cli::UsageError(fmt::format("{} {}: {}", origin, scene::excerpt(all), allowed));
    }
    if (part.last < part.first) {
        throw cli::UsageError(fmt::format("{} {}: ends before it begins, {}", origin, scene::excerpt(all), allowed));
    }
    return part;
}

}  // namespace

FrameList::FrameList(std::vector<int> numbers) : numbers_(std::move(numbers)) {
    std::ranges::sort(numbers_);
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
}

FrameList FrameList::range(int first, int last, int step) {
    std::vector<int> numbers;
    for (long long frame = first; frame <= last; frame += step) numbers.push_back(static_cast<int>(frame));
    return FrameList(std::move(numbers));
}

std::optional<int> FrameList::step() const {
    if (count() == 1) return 1;
    const int step = numbers_[1] - numbers_[0];
    for (std::size_t i = 2; i < numbers_.size(); ++i) {
        if (numbers_[i] - numbers_[i - 1] != step) return std::nullopt;
    }
    return step;
}

FrameList parse_frames(const std::string& text, const std::string& origin) {
    std::vector<int> numbers;
    std::size_t start = 0;
    while (start <= text.size()) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        const Part part = parse_part(origin, text, text.substr(start, end - start));
        const std::size_t count = numbers.size() + static_cast<std::size_t>((part.last - part.first) / part.step) + 1;
        if (count > kMostFrames) {
            throw cli::UsageError(
                fmt::format("{} {}: {} of them, allowed: up to {}", origin, scene::excerpt(text), count, kMostFrames));
        }
        for (int i = 0; i <= (part.last - part.first) / part.step; ++i) numbers.push_back(part.first + i * part.step);
        start = end + 1;
    }
    return FrameList(std::move(numbers));
}

std::optional<int> loop_frames(const scene::Scene& scene) {
    const double fps = scene.shutter.fps;
    if (scene.image == scene::ImageKind::wheel) {
        return frames_to_repeat(scene.wheel.turns_per_s * scene.wheel.spokes / fps);
    }
    if (scene.image != scene::ImageKind::surface || scene.camera.keys.size() > 1) return std::nullopt;
    if (scene.surface.drift != glm::dvec3(0.0) || scene::clouds_drift(scene)) return std::nullopt;
    return frames_to_repeat(scene.surface.spin_deg_per_s / 360.0 / fps);
}

FrameList default_frames(const scene::Scene& scene) {
    if (const auto frames = loop_frames(scene)) return FrameList::range(0, *frames - 1);
    if (scene.image == scene::ImageKind::surface && scene.camera.keys.size() > 1) {
        const double last = std::ceil(scene.camera.keys.back().time_s * scene.shutter.fps - 1e-9);
        if (last >= 1.0 && last < kMostFrames) return FrameList::range(0, static_cast<int>(last));
    }
    throw cli::UsageError(
        "--frames is needed: nothing in this scene tells where it ends (camera.keys do, and a surface.spin_deg_per_s "
        "or wheel.turns_per_s that loops in a whole number of frames)");
}

}  // namespace strata::tools::animate
