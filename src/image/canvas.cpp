#include "src/image/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/image/canvas_buffer.h"
#include "src/image/dither.h"
#include "src/image/encode.h"
#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/library.h"
#include "src/image/not_finite.h"
#include "src/image/output_file.h"

namespace strata::image {
namespace {

using namespace OIIO;

constexpr float kCode = 1.0f / 255.0f;  // a factor, as read_picture() has it: the same floats

std::array<float, 3> values_of(const Colour& colour) { return {colour.r, colour.g, colour.b}; }

Canvas blank(int width, int height) {
    Canvas canvas{width, height, {}};
    canvas.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return canvas;
}

ROI roi_of(const Box& box) { return {box.x0, box.x1, box.y0, box.y1, 0, 1, 0, 3}; }

Box intersection(const Box& a, const Box& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

bool is_empty(const Box& box) { return box.x0 >= box.x1 || box.y0 >= box.y1; }

}  // namespace

ImageBuf buffer_of(Canvas& canvas) {
    configure_library();
    return ImageBuf(ImageSpec(canvas.width, canvas.height, 3, TypeDesc::FLOAT), canvas.rgb.data());
}

ImageBuf buffer_of(const Canvas& canvas) {
    // ImageBuf wraps memory that may be written to; as a source none of it is.
    return buffer_of(const_cast<Canvas&>(canvas));
}

void require_drawn(bool done, const ImageBuf& buffer) {
    if (!done) throw ImageError(fmt::format("cannot draw: {}", buffer.geterror()));
}

Canvas make_canvas(int width, int height, const Colour& colour) {
    Canvas canvas = blank(width, height);
    fill(canvas, canvas.box(), colour);
    return canvas;
}

Canvas to_canvas(const Picture& linear, const ColourOut& colour) {
    const ColourEncoder encode(colour);
    Canvas canvas = blank(linear.width(), linear.height());
    const std::array<float, 3> not_finite = values_of(kNotFiniteColour);
    for (std::size_t i = 0; i < linear.pixels(); ++i) {
        const auto width = static_cast<std::size_t>(linear.width());
        const int x = linear.x0 + static_cast<int>(i % width), y = linear.y0 + static_cast<int>(i / width);
        if (!is_finite_pixel(linear, i)) {
            std::ranges::copy(not_finite, canvas.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
            continue;
        }
        const glm::dvec3 encoded = encode(&linear.rgb[3 * i]);
        // Codes already here, from the double: a float between two codes could fall to the other side later.
        for (int c = 0; c < 3; ++c) {
            const int code = dithered_code(encoded[c], x, y);
            canvas.rgb[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(code) * kCode;
        }
    }
    return canvas;
}

Canvas crop(const Canvas& canvas, const Box& box) {
    if (is_empty(box) || intersection(box, canvas.box()) != box) {
        throw ImageError(fmt::format("the crop {},{},{},{} is empty or outside the {}x{} picture", box.x0, box.y0,
                                     box.x1, box.y1, canvas.width, canvas.height));
    }
    Canvas part = blank(box.width(), box.height());
    ImageBuf target = buffer_of(part);
    require_drawn(ImageBufAlgo::paste(target, -box.x0, -box.y0, 0, 0, buffer_of(canvas)), target);
    return part;
}

Canvas magnify(const Canvas& canvas, int zoom) {
    if (zoom < 1 || std::max(canvas.width, canvas.height) > kLongestSide / zoom) {
        throw ImageError(fmt::format("{}x{} pixels magnified {} times: allowed: at most {} pixels a side", canvas.width,
                                     canvas.height, zoom, kLongestSide));
    }
    if (zoom == 1) return canvas;
    Canvas large = blank(canvas.width * zoom, canvas.height * zoom);
    ImageBuf target = buffer_of(large);
    constexpr bool kInterpolate = false;
    require_drawn(ImageBufAlgo::resample(target, buffer_of(canvas), kInterpolate), target);
    return large;
}

void paste(Canvas& canvas, const Canvas& what, int x, int y) {
    ImageBuf target = buffer_of(canvas);
    require_drawn(ImageBufAlgo::paste(target, x, y, 0, 0, buffer_of(what)), target);
}

void fill(Canvas& canvas, const Box& box, const Colour& colour) {
    const Box inside = intersection(box, canvas.box());
    if (is_empty(inside)) return;
    ImageBuf target = buffer_of(canvas);
    require_drawn(ImageBufAlgo::fill(target, values_of(colour), roi_of(inside)), target);
}

void outline(Canvas& canvas, const Box& box, const Colour& colour, int thickness) {
    const Box around{box.x0 - thickness, box.y0 - thickness, box.x1 + thickness, box.y1 + thickness};
    fill(canvas, {around.x0, around.y0, around.x1, box.y0}, colour);
    fill(canvas, {around.x0, box.y1, around.x1, around.y1}, colour);
    fill(canvas, {around.x0, box.y0, box.x0, box.y1}, colour);
    fill(canvas, {box.x1, box.y0, around.x1, box.y1}, colour);
}

void check_canvas_format(const std::filesystem::path& path) {
    if (format_of(path) != Format::exr) return;
    throw ImageError(
        fmt::format("cannot write \"{}\": a picture with text and frames is no radiance; allowed: .png, .jpg, .tif",
                    path.string()));
}

std::vector<unsigned char> encode_canvas(const std::filesystem::path& path, const Canvas& canvas,
                                         const Metadata& metadata) {
    check_canvas_format(path);
    return encode_codes(path, {canvas.width, canvas.height, 0, 0, canvas.width, canvas.height, canvas.rgb}, metadata);
}

void write_canvas(const std::filesystem::path& path, const Canvas& canvas, const Metadata& metadata) {
    replace_file(path, encode_canvas(path, canvas, metadata));
}

}  // namespace strata::image
