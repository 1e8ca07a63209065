#include "src/image/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/image/canvas_buffer.h"
#include "src/image/compare.h"
#include "src/image/house_style.h"
#include "src/image/srgb.h"

namespace strata::image {
namespace {

constexpr const char* kMap = "inferno";
constexpr int kBarHeight = 14;
constexpr int kTickHeight = 4;

// Where a distance, in parts of the top, lies on the scale.
double place_of(double part) { return std::sqrt(std::min(1.0, part)); }

// Fractions [0,1] of the scale, one a pixel, in its colours.
Canvas colours_of(std::vector<float>& fractions, int width, int height) {
    Canvas canvas = make_canvas(width, height, {});
    const OIIO::ImageBuf source(OIIO::ImageSpec(width, height, 1, OIIO::TypeDesc::FLOAT), fractions.data());
    OIIO::ImageBuf target = buffer_of(canvas);
    require_drawn(OIIO::ImageBufAlgo::color_map(target, source, 0, kMap), target);
    // OpenImageIO has the map's colours as linear light.
    for (float& value : canvas.rgb) value = static_cast<float>(encode_srgb(value));
    return canvas;
}

}  // namespace

Canvas difference(const Picture& picture, const Picture& reference, double top) {
    require_equal_sizes(picture, reference);
    std::vector<float> fractions(picture.pixels());
    std::vector<std::size_t> not_finite;
    for (std::size_t i = 0; i < fractions.size(); ++i) {
        double square = 0;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const double d = static_cast<double>(picture.rgb[c]) - reference.rgb[c];
            square += d * d / 3;
        }
        if (std::isfinite(square))
            fractions[i] = static_cast<float>(place_of(std::sqrt(square) / top));
        else
            not_finite.push_back(i);
    }
    Canvas canvas = colours_of(fractions, picture.width(), picture.height());
    for (const std::size_t i : not_finite) {
        canvas.rgb[3 * i] = kNotFiniteColour.r;
        canvas.rgb[3 * i + 1] = kNotFiniteColour.g;
        canvas.rgb[3 * i + 2] = kNotFiniteColour.b;
    }
    return canvas;
}

double scale_top(double value) {
    if (!(value > 0) || !std::isfinite(value)) return 1;
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= value) return step * power;
    return 10 * power;
}

Canvas difference_scale(int width, double top, const std::string& label) {
    const TextStyle numbers{.size_px = house::kNote_px, .colour = house::kInk};
    const TextStyle words{.size_px = house::kNote_px, .colour = house::kMuted};
    const std::string wrapped = wrap(label, width, words);
    const int below = 1 + kBarHeight + 1 + kTickHeight;
    const int line = line_height(numbers);
    Canvas canvas = make_canvas(width, below + line + line_count(wrapped) * line_height(words), house::kPaper);
    const int bar_width = width - 2;
    std::vector<float> fractions;
    for (int y = 0; y < kBarHeight; ++y)
        for (int x = 0; x < bar_width; ++x)
            fractions.push_back((static_cast<float>(x) + 0.5f) / static_cast<float>(bar_width));
    const Box bar{1, 1, 1 + bar_width, 1 + kBarHeight};
    paste(canvas, colours_of(fractions, bar_width, kBarHeight), bar.x0, bar.y0);
    outline(canvas, bar, house::kRule);

    const auto mark = [&](double part, Anchor anchor) {
        const int x = static_cast<int>(std::lround(place_of(part) * (width - 1)));
        fill(canvas, {x, bar.y1, x + 1, below}, house::kInk);
        TextStyle style = numbers;
        style.anchor = anchor;
        // A right anchor is the end of the text, which the last column still belongs to.
        draw_text(canvas, anchor == Anchor::right ? width : x, below,
                  fmt::format("{}{:.4g}", part == 1 ? "≥ " : "", part * top), style);
    };
    mark(0, Anchor::left);
    for (const double part : {0.02, 0.1, 0.4}) mark(part, Anchor::centre);
    mark(1, Anchor::right);
    draw_text(canvas, 0, below + line, wrapped, words);
    return canvas;
}

}  // namespace strata::image
