#include "tools/job/cost_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/image/difference.h"
#include "src/image/sheet.h"

namespace strata::tools::job {

namespace {

image::Picture grey(int width, int height, float value) {
    image::Picture picture = image::make_picture(width, height);
    std::ranges::fill(picture.rgb, value);
    return picture;
}

}  // namespace

CostPicture::CostPicture(const ChannelSet::Entry& aov, const film::Rect& window) : aov_(aov), window_(window) {
    const auto divide_up = [](int a, int b) { return (a + b - 1) / b; };
    block_ = divide_up(std::max(window.width(), window.height()), kLongestCostSide);
    width_ = divide_up(window.width(), block_);
    height_ = divide_up(window.height(), block_);
    sum_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0);
}

void CostPicture::add(const film::Film& strip) {
    const film::Rect& w = strip.window();
    for (int y = w.y0 - window_.y0; y < w.y1 - window_.y0; ++y) {
        double* row = &sum_[static_cast<std::size_t>(y / block_) * static_cast<std::size_t>(width_)];
        for (int x = 0; x < w.width(); ++x) {
            const double value = static_cast<double>(strip.channels_at(w.x0 + x, window_.y0 + y)[aov_.first]);
            row[x / block_] += value;
            whole_sum_ += value;
        }
    }
}

image::Canvas CostPicture::draw(const std::string& title) const {
    image::Picture picture = image::make_picture(width_, height_);
    double largest = 0;
    for (int y = 0; y < height_; ++y) {
        const int rows = std::min(block_, window_.height() - y * block_);
        for (int x = 0; x < width_; ++x) {
            const int columns = std::min(block_, window_.width() - x * block_);
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
            const double mean = sum_[i] / (1.0 * rows * columns);
            std::fill_n(&picture.rgb[3 * i], 3, static_cast<float>(mean));
            largest = std::max(largest, mean);
        }
    }
    const double top = image::scale_top(largest);
    image::Sheet sheet;
    sheet.title = title;
    const image::Canvas canvas = image::difference(picture, grey(width_, height_, 0.0f), top);
    sheet.rows = {{{canvas, "", false}}};
    sheet.scale = image::difference_scale(std::clamp(width_, 320, 640), top, std::string(aov_.channel->meaning));
    const double pixels = 1.0 * window_.width() * window_.height();
    sheet.caption = fmt::format("{}x{} pixels, mean {:.4g}, largest {:.4g}{}", window_.width(), window_.height(),
                                whole_sum_ / pixels, largest,
                                block_ > 1 ? fmt::format("; each dot the mean of {0}x{0} pixels", block_) : "");
    return image::compose(sheet);
}

}  // namespace strata::tools::job
