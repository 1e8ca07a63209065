// What a film holds beside radiance, as floats pixel by pixel: for whoever keeps them and does not ask what they mean.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "src/film/film.h"

namespace strata::tools::job {

inline std::size_t channel_values(const film::Film& film) { return film.costs().empty() ? 0 : 2; }

inline std::span<const float> channels_of(const film::Film& film) {
    return film.costs().empty() ? std::span<const float>() : std::span(&film.costs()[0].x, 2 * film.costs().size());
}

inline void set_channels(film::Film& film, int x, int y, const float* values) {
    film.set_cost(x, y, {values[0], values[1]});
}

}  // namespace strata::tools::job
