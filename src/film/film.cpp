#include "src/film/film.h"

#include <algorithm>

namespace strata::film {

Film::Film(const Rect& window, const FilmExtras& extras)
    : window_(window),
      pixels_(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height()), glm::vec3(0)),
      finished_(pixels_.size(), 0),
      costs_(extras.costs ? pixels_.size() : 0, glm::vec2(0)),
      weights_(extras.weights ? pixels_.size() : 0, 0.0) {}

std::size_t Film::finished_count() const {
    return static_cast<std::size_t>(std::count(finished_.begin(), finished_.end(), std::uint8_t{1}));
}

void Film::paste(const Film& part) {
    const Rect& w = part.window();
    for (int y = w.y0; y < w.y1; ++y) {
        for (int x = w.x0; x < w.x1; ++x) {
            if (!part.finished(x, y)) continue;
            finish(x, y, part.at(x, y));
            if (!costs_.empty() && !part.costs_.empty()) costs_[index(x, y)] = part.costs_[part.index(x, y)];
            if (!weights_.empty() && !part.weights_.empty()) weights_[index(x, y)] = part.weights_[part.index(x, y)];
        }
    }
}

}  // namespace strata::film
