// The paper's two animations, made by `strata animate` beside the figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/figures/figure.h"

namespace strata::tools::figures {

struct FilmOptions {
    std::filesystem::path folder;
    Size size = Size::paper;
    std::string threads = "0";
    bool quiet = false, overwrite = false;
};

struct Film {
    std::string name;  // "animation-1": of its files, .webm, .mp4 and .json
    std::string title, caption;
    std::vector<std::string> settings;  // after `strata animate`: scene and size
};

std::vector<Film> films(Size size);

// "animation-1.webm" and "animation-1.mp4".
std::vector<std::string> film_files(const Film& film);

// One line, as a figure's record.
nlohmann::ordered_json film_record(const Film& film);

// Whether the film is there, whole and as it would be made. Tells what is damaged unless quiet.
bool is_made(const Film& film, const std::filesystem::path& folder, bool quiet);

// Makes a film and its record. False when it was interrupted: its frames are kept. Throws what `strata animate` throws.
bool make_film(const Film& film, const FilmOptions& options);

}  // namespace strata::tools::figures
