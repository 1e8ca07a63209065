#include "src/render/film.h"

#include <algorithm>

namespace strata::render {

Film::Film(const Window& window)
    : window_(window),
      pixels_(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height()), glm::vec3(0)),
      finished_(pixels_.size(), 0) {}

std::size_t Film::finished_count() const {
    return static_cast<std::size_t>(std::count(finished_.begin(), finished_.end(), std::uint8_t{1}));
}

}  // namespace strata::render
