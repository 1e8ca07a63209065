// What a film holds beside radiance, as floats pixel by pixel: for whoever keeps them and does not ask what they mean.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "src/film/film.h"

namespace strata::tools::job {

inline std::size_t channel_values(const film::Film& film) {
    return film.pixels().empty() ? 0 : film.channels().size() / film.pixels().size();
}

inline std::span<const float> channels_of(const film::Film& film) { return film.channels(); }

inline void set_channels(film::Film& film, int x, int y, const float* values) {
    const std::span<float> channels = film.channels_at(x, y);
    std::copy_n(values, channels.size(), channels.begin());
}

}  // namespace strata::tools::job
