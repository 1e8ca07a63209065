// Linear RGB pixels of a crop window inside a frame.
#pragma once

#include <cstddef>
#include <vector>

namespace strata::image {

// The crop of a picture without its pixels.
struct PictureShape {
    int frame_width = 0;
    int frame_height = 0;
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool operator==(const PictureShape&) const = default;
};

// The crop [x0,x1) x [y0,y1) in frame pixels, y down, not empty and inside the frame.
// rgb holds its rows from the top, three floats a pixel.
struct Picture {
    int frame_width = 0;
    int frame_height = 0;
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    std::vector<float> rgb;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    std::size_t pixels() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }
    PictureShape shape() const { return {frame_width, frame_height, x0, y0, x1, y1}; }
};

// A black picture of a whole frame.
inline Picture make_picture(int width, int height) {
    Picture picture{width, height, 0, 0, width, height, {}};
    picture.rgb.resize(3 * picture.pixels());
    return picture;
}

}  // namespace strata::image
