// index.html beside the figures: each with its caption, parameters and command, sliders between pictures, films.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools::figures {

// A film of the paper, where the folder holds it.
struct Film {
    std::string name;  // "animation-1": of its files, .webm and .mp4
    std::string title, caption, command;
};
const std::vector<Film>& films();

// What the page is made of, as embedded when the program was built.
struct PageTexts {
    std::string_view html, css, js;
};
const PageTexts& page_texts();

// Text as it may stand in HTML and in a quoted attribute.
std::string escaped(std::string_view text);

// The page of these figures (figure.h, record_of) and films, in their order: style and script within, pictures referred
// to by name, nothing from elsewhere. film_files: those of the folder, "animation-1.webm".
std::string page_of(const std::vector<nlohmann::ordered_json>& records, const std::vector<std::string>& film_files);

// Writes folder/index.html from the figures and films that the folder holds. Throws ImageError, and std::runtime_error
// for a folder without figures.
void write_page(const std::filesystem::path& folder);

}  // namespace strata::tools::figures
