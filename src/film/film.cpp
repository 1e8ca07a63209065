#include "src/film/film.h"

#include <algorithm>

namespace strata::film {

Film::Film(const Rect& window, const FilmExtras& extras)
    : window_(window),
      pixels_(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height()), glm::vec3(0)),
      finished_(pixels_.size(), 0),
      channel_values_(extras.channel_values),
      channels_(pixels_.size() * extras.channel_values, 0.0f),
      weights_(extras.weights ? pixels_.size() : 0, 0.0) {}

std::size_t Film::finished_count() const {
    return static_cast<std::size_t>(std::count(finished_.begin(), finished_.end(), std::uint8_t{1}));
}

void Film::paste(const Film& part, int dx, int dy) {
    const Rect& w = part.window();
    for (int y = w.y0; y < w.y1; ++y) {
        for (int x = w.x0; x < w.x1; ++x) {
            if (!part.finished(x, y)) continue;
            const std::size_t here = index(x + dx, y + dy), there = part.index(x, y);
            finish(x + dx, y + dy, part.pixels_[there]);
            if (channel_values_ > 0) std::ranges::copy(part.channels_at(x, y), channels_at(x + dx, y + dy).begin());
            if (!weights_.empty() && !part.weights_.empty()) weights_[here] = part.weights_[there];
        }
    }
}

}  // namespace strata::film
