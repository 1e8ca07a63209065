// Words on a canvas, in DejaVu Sans (Debian package fonts-dejavu-core).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/image/canvas.h"
#include "src/image/house_style.h"

namespace strata::image {

enum class Anchor { left, centre, right };
enum class Weight { regular, bold };

struct TextStyle {
    int size_px = house::kLabel_px;  // nominal height of the font
    Colour colour = house::kInk;
    Anchor anchor = Anchor::left;
    Weight weight = Weight::regular;
};

// Throws ImageError, naming the package, unless the fonts are there: to be called before long work that ends in text.
void check_fonts();

// The first that is a file. Throws ImageError, naming the package, when none is.
std::filesystem::path find_font(std::span<const std::filesystem::path> candidates);

// Distance of one line's top from the next one's, in pixels: equal for all texts of a size.
int line_height(const TextStyle& style);

// Width in pixels of the longest line of a UTF-8 text.
int text_width(std::string_view text, const TextStyle& style);

// Draws UTF-8 text whose line feeds start new lines. (x,y): the top of the first line, at its left end, middle or right
// end by the anchor; each line is anchored by itself. Returns the height drawn over: line_height a line.
int draw_text(Canvas& canvas, int x, int y, std::string_view text, const TextStyle& style = {});

// The text in lines no wider than width_px, broken at blanks, but not beside a '='; line feeds stay. A word that is
// wider alone is broken between characters.
std::string wrap(std::string_view text, int width_px, const TextStyle& style);

// The number of lines of a text, at least 1.
int line_count(std::string_view text);

}  // namespace strata::image
