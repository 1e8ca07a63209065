#include "tools/animate/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>

#include "src/image/image_error.h"
#include "src/image/read.h"
#include "src/scene/key_text.h"
#include "tools/errors.h"

namespace strata::tools {

namespace fs = std::filesystem;

namespace {

// A line of a printed scene without its comment.
std::string_view setting_of(std::string_view line) {
    line = line.substr(0, line.find(" #"));
    return line.substr(0, line.find_last_not_of(' ') + 1);
}

// The first line in which two texts differ.
std::string difference(std::string_view found, std::string_view expected) {
    while (!found.empty() && !expected.empty()) {
        const std::string_view a = found.substr(0, found.find('\n')), b = expected.substr(0, expected.find('\n'));
        if (a != b) return fmt::format("'{}', not '{}'", scene::excerpt(setting_of(a)), scene::excerpt(setting_of(b)));
        found.remove_prefix(std::min(found.size(), a.size() + 1));
        expected.remove_prefix(std::min(expected.size(), b.size() + 1));
    }
    return "longer or shorter";
}

}  // namespace

FramePattern::FramePattern(const fs::path& typed) : folder_(typed.parent_path()) {
    const std::string name = typed.filename().string();
    const auto first = name.find('#');
    if (folder_.string().find('#') != std::string::npos) {
        throw UsageError(fmt::format("-o {}: '#' in a folder's name, allowed: in the file's", typed.string()));
    }
    if (first == std::string::npos) {
        before_ = typed.stem().string() + ".";
        after_ = typed.extension().string();
        return;
    }
    const auto end = std::min(name.find_first_not_of('#', first), name.size());
    if (name.find('#', end) != std::string::npos) {
        throw UsageError(fmt::format("-o {}: '#' in several places, allowed: one run of them", typed.string()));
    }
    before_ = name.substr(0, first);
    after_ = name.substr(end);
    digits_ = static_cast<int>(end - first);
}

fs::path FramePattern::path(int frame) const {
    return folder_ / fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

std::string FramePattern::text() const {
    return (folder_ / (before_ + std::string(static_cast<std::size_t>(digits_), '#') + after_)).string();
}

FoundFrame find_frame(const fs::path& path, const image::Metadata& expected, int width, int height) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(path, error))) return {};
    if (!image::is_picture(path)) return {FrameState::other, "it is no picture"};
    try {
        for (const auto& [name, value] : expected.entries()) {
            const auto found = image::read_metadata(path, name);
            if (!found) return {FrameState::other, fmt::format("it does not say its {}", name)};
            if (*found == value) continue;
            return {FrameState::other, fmt::format("its {} is {}", name, difference(*found, value))};
        }
        const image::Picture picture = image::read_picture(path);
        if (picture.width() != width || picture.height() != height) {
            return {FrameState::other,
                    fmt::format("it has {}x{} pixels, not {}x{}", picture.width(), picture.height(), width, height)};
        }
    } catch (const image::ImageError& damaged) {
        return {FrameState::other, damaged.what()};
    }
    return {FrameState::whole, {}};
}

}  // namespace strata::tools
