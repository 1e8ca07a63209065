#include "tools/animate/frames.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/image/file_paths.h"
#include "tools/cli/errors.h"

namespace strata::tools::animate {

namespace fs = std::filesystem;

// Of several runs of '#' the last one is the number: the others are part of a name such as "shot #2".
FramePattern::FramePattern(const fs::path& typed) : folder_(typed.parent_path()) {
    const std::string name = typed.filename().string();
    const auto last = name.rfind('#');
    if (last == std::string::npos) {
        // Room for the longest number.
        after_ = typed.extension().string();
        constexpr std::size_t kLongestName = 255, kLongestNumber = 10;
        const std::size_t rest = kLongestNumber + after_.size();
        before_ = image::fitting_name(typed.stem().string(), ".", kLongestName - std::min(rest, kLongestName));
        return;
    }
    const auto before_run = name.find_last_not_of('#', last);
    const std::size_t first = before_run == std::string::npos ? 0 : before_run + 1;
    before_ = name.substr(0, first);
    after_ = name.substr(last + 1);
    digits_ = static_cast<int>(last + 1 - first);
}

fs::path FramePattern::path(int frame) const {
    return folder_ / fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

std::string FramePattern::text() const {
    return (folder_ / (before_ + std::string(static_cast<std::size_t>(digits_), '#') + after_)).string();
}

}  // namespace strata::tools::animate
