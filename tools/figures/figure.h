// A figure of the paper: what it is made of, all parameters included, and how it is put together.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/image/picture.h"
#include "src/image/sheet.h"
#include "src/scene/scene.h"
#include "tools/job/picture_job.h"

namespace strata::tools::figures {

enum class Size { small, paper, large };

inline constexpr std::string_view kSizeNames[] = {"small", "paper", "large"};

// A length in pixels at size paper, at another size: half for small, twice for large.
int scaled(int pixels, Size size);

// A picture that a figure is assembled from, written as float EXR.
struct Part {
    std::string file;  // "figure-6-none.exr"
    scene::Scene scene;
    film::Rect window;
    double cost = 1;  // of a ray, relative to others: for the progress

    job::PictureJob job() const { return {scene, window}; }
};

// A file to look at.
struct Shown {
    std::string file;
    std::string alt;  // what is to be seen, for those who cannot see it
};

// Two pictures of equal size that are worth swapping.
struct Comparison {
    std::string left, right;  // files
    std::string left_label, right_label;
};

struct Plan {
    int number = 0;
    std::string title;
    std::string caption;
    std::vector<std::string> chosen;  // what the paper does not tell
    std::vector<Shown> shown;         // the whole figure first
    std::vector<Part> parts;
    std::vector<std::string> data;  // other files
    std::vector<Comparison> comparisons;
    nlohmann::ordered_json parameters = nlohmann::ordered_json::object();  // what no part's scene tells
};

using Pictures = std::span<const image::Picture>;  // of the plan's parts, in their order

struct Figure {
    int number;
    bool is_plot;
    Plan (*plan)(Size);
    void (*draw)(const Plan&, Pictures, const std::filesystem::path& folder);
};

// By number.
std::span<const Figure> all_figures();

// Everything about a figure, timings and threads apart: equal records are equal figures on one version and SIMD target.
nlohmann::ordered_json record_of(const Plan& plan, Size size);

// Writes the whole figure, the first of what is shown: the sheet under the figure's title and over its caption.
void write_sheet(const Plan& plan, image::Sheet sheet, const std::filesystem::path& folder);

// A built-in scene.
scene::Scene builtin(std::string_view name);

// One file a figure.
extern const Figure kFigure1, kFigure2, kFigure3, kFigure4, kFigure5, kFigure6, kFigure7, kFigure8;

}  // namespace strata::tools::figures
