// index.html beside the figures and films: each with its caption, parameters and command, sliders between pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace strata::tools::figures {

// The page of these figures (record_of) and films (film_record), in their order: style, script and the records within,
// from which the script builds what is seen; pictures and films referred to by name, nothing from elsewhere.
std::string page_of(const std::vector<nlohmann::ordered_json>& figures,
                    const std::vector<nlohmann::ordered_json>& films);

// Writes folder/index.html from the figures and films that the folder holds. Throws ImageError, and std::runtime_error
// for a folder without figures.
void write_page(const std::filesystem::path& folder);

}  // namespace strata::tools::figures
