// Pictures to look at: figures, comparison strips, contact sheets. A canvas holds what a screen is sent, not light.
#pragma once

#include <filesystem>
#include <vector>

#include "src/image/colour_out.h"
#include "src/image/metadata.h"
#include "src/image/picture.h"

namespace strata::image {

// sRGB codes in [0,1].
struct Colour {
    float r = 0, g = 0, b = 0;
    bool operator==(const Colour&) const = default;
};

// Pixels [x0,x1) x [y0,y1), y down.
struct Box {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool operator==(const Box&) const = default;
};

// Rows from the top, three sRGB codes in [0,1] a pixel.
struct Canvas {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;

    Box box() const { return {0, 0, width, height}; }
};

// All drawing keeps to the canvas: what lies outside is left out. Sizes are at least 1.
Canvas make_canvas(int width, int height, const Colour& colour);

// Of a pixel that is not finite, which only pictures of other programs have.
inline constexpr Colour kNotFiniteColour{0.0f, 1.0f, 1.0f};

// The crop of a picture of linear radiance, as a PNG with these colours would show it, code for code; pixels that are
// not finite in kNotFiniteColour.
Canvas to_canvas(const Picture& linear, const ColourOut& colour = {});

// Throws ImageError, naming both, when the box is empty or not inside the canvas.
Canvas crop(const Canvas& canvas, const Box& box);

// Each pixel as zoom x zoom equal pixels, zoom >= 1. Throws ImageError when a side would pass kLongestSide.
Canvas magnify(const Canvas& canvas, int zoom);

inline constexpr int kLongestSide = 65'500;  // of a magnified canvas: what every format it is written to holds

// Puts `what` with its top left pixel at (x,y).
void paste(Canvas& canvas, const Canvas& what, int x, int y);

void fill(Canvas& canvas, const Box& box, const Colour& colour);

// A frame whose lines, `thickness` pixels wide, lie just outside of the box: nothing in it is covered.
void outline(Canvas& canvas, const Box& box, const Colour& colour, int thickness = 1);

// A file's bytes: PNG, JPEG or TIFF by extension, codes as they are, rounded to the format's; the same for equal
// arguments. Throws ImageError, as encode() does, and for EXR, which holds light.
std::vector<unsigned char> encode_canvas(const std::filesystem::path& path, const Canvas& canvas,
                                         const Metadata& metadata = {});

// Puts these bytes in place whole, as write_picture() does.
void write_canvas(const std::filesystem::path& path, const Canvas& canvas, const Metadata& metadata = {});

// Throws ImageError if write_canvas() has no format for this path; does not look at the disk.
void check_canvas_format(const std::filesystem::path& path);

}  // namespace strata::image
