#include "src/journal/kept_pixels.h"

#include <algorithm>

namespace strata::journal {
namespace {

bool is_inside(const film::Rect& rect, const film::Rect& window) {
    return rect.x0 >= window.x0 && rect.x1 <= window.x1 && rect.y0 >= window.y0 && rect.y1 <= window.y1;
}

}  // namespace

KeptPixels::KeptPixels(const film::StripLayout& layout)
    : layout_(layout), strips_(static_cast<std::size_t>(layout.count())) {}

std::int64_t KeptPixels::area(int strip) const {
    const film::Rect window = layout_.strip(strip);
    return std::int64_t{1} * window.width() * window.height();
}

bool KeptPixels::add(const RecordPlace& place, std::span<const film::Rect> rects) {
    const auto is_possible = [&](const film::Rect& rect) {
        return is_inside(rect, layout_.window) && is_inside(rect, layout_.strip(layout_.strip_at(rect.y0)));
    };
    if (!std::ranges::all_of(rects, is_possible)) return false;
    for (const film::Rect& rect : rects) {
        const int number = layout_.strip_at(rect.y0);
        std::vector<RecordPlace>& records = strips_[static_cast<std::size_t>(number)].records;
        if (records.empty() || records.back().offset != place.offset) records.push_back(place);
        mark(number, rect);
    }
    return true;
}

void KeptPixels::mark(int number, const film::Rect& rect) {
    Strip& strip = strips_[static_cast<std::size_t>(number)];
    const std::int64_t all = area(number);
    if (strip.count == all) return;
    const film::Rect window = layout_.strip(number);
    const std::int64_t before = strip.count;
    if (rect == window) {
        strip.count = all;
    } else {
        strip.there.resize(static_cast<std::size_t>(all));
        for (int y = rect.y0; y < rect.y1; ++y) {
            const std::int64_t row = std::int64_t{y - window.y0} * window.width() - window.x0;
            for (int x = rect.x0; x < rect.x1; ++x) {
                auto bit = strip.there[static_cast<std::size_t>(row + x)];
                if (!bit) ++strip.count;
                bit = true;
            }
        }
    }
    if (strip.count == all) std::vector<bool>().swap(strip.there);
    pixels_ += strip.count - before;
}

bool KeptPixels::has(const film::Rect& rect) const {
    const int number = layout_.strip_at(rect.y0);
    const Strip& strip = strips_[static_cast<std::size_t>(number)];
    if (strip.count == 0) return false;
    if (strip.count == area(number)) return true;
    const film::Rect window = layout_.strip(number);
    for (int y = rect.y0; y < rect.y1; ++y) {
        const std::int64_t row = std::int64_t{y - window.y0} * window.width() - window.x0;
        const auto begin = strip.there.begin() + row;
        if (!std::all_of(begin + rect.x0, begin + rect.x1, [](bool there) { return there; })) return false;
    }
    return true;
}

}  // namespace strata::journal
