// The paper's two animations, made as by `strata animate` beside the figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/figures/figure_maker.h"

namespace strata::tools::figures {

struct Film {
    std::string name;  // "animation-1": of its files, .webm, .mp4 and .json
    std::string title, caption;
    std::string scene;  // a built-in one
    int width = 0, height = 0;
};

std::vector<Film> films(Size size);

// "animation-1.webm" and "animation-1.mp4".
std::vector<std::string> film_files(const Film& film);

// One line, as a figure's record.
nlohmann::ordered_json film_record(const Film& film);

// Whether the film is there, whole and as it would be made. Tells what is damaged unless quiet.
bool is_made(const Film& film, const MakeOptions& options);

// Makes a film and its record. False when it was interrupted: its frames are kept. Throws what `strata animate` throws,
// and ProcessError when it could not be made.
bool make_film(const Film& film, const MakeOptions& options, const parallel::CancelToken& cancel);

}  // namespace strata::tools::figures
