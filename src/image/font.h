// Glyphs of a font file on a canvas, by FreeType: OpenImageIO 2.4's render_text() cannot decode UTF-8 beyond ASCII.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "src/image/canvas.h"

namespace strata::image {

// One font file at one size at a time. Glyphs stand at fractions of pixels, kerned; not to be shared by threads.
class Font {
  public:
    // Throws ImageError when the file is no font.
    explicit Font(const std::filesystem::path& path);
    ~Font();
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    // Pixels an em, >= 1.
    void set_size(int size_px);

    // How far a line of UTF-8 moves the pen, in pixels. Bytes that are no UTF-8, and control characters, count as
    // U+FFFD.
    double advance_px(std::string_view line);

    // Draws a line of UTF-8, the pen starting at (x, baseline). What lies outside of the canvas is left out.
    void draw(Canvas& canvas, int x, int baseline, std::string_view line, const Colour& colour);

  private:
    struct Face;
    std::unique_ptr<Face> face_;
};

// The code point that a UTF-8 text, not empty, begins with, which is removed from it; U+FFFD for what is none.
char32_t take_code_point(std::string_view& text);

}  // namespace strata::image
