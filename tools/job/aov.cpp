#include "tools/job/aov.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/image/difference.h"
#include "src/image/sheet.h"
#include "src/scene/key_text.h"
#include "tools/cli/errors.h"

namespace strata::tools::job {

namespace {

float value_of(Aov aov, const glm::vec2& cost) { return aov == Aov::steps ? cost.x : cost.y; }

const char* meaning(Aov aov) {
    return aov == Aov::steps ? "tracer steps a sample, shadow rays' included"
                             : "noise evaluations a sample (octaves at points), shadow rays' and normals' included";
}

image::Picture grey(int width, int height, float value) {
    image::Picture picture = image::make_picture(width, height);
    std::ranges::fill(picture.rgb, value);
    return picture;
}

}  // namespace

std::string name_of(Aov aov) { return aov == Aov::steps ? "steps" : "evals"; }

std::vector<Aov> parse_aovs(const std::string& text) {
    std::vector<Aov> aovs;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        begin = end + 1;
        if (word != "steps" && word != "evals") {
            throw cli::UsageError(
                fmt::format("--aov {}: allowed: steps, evals, or both with a comma", scene::excerpt(text)));
        }
        const Aov aov = word == "steps" ? Aov::steps : Aov::evals;
        if (std::ranges::find(aovs, aov) == aovs.end()) aovs.push_back(aov);
    }
    std::ranges::sort(aovs);
    return aovs;
}

std::vector<Aov> aovs_of(const std::string& typed, const cli::LoadedScene& loaded, int passes) {
    if (typed.empty() && !loaded.aovs) return {};
    std::vector<Aov> aovs = parse_aovs(!typed.empty() ? typed : *loaded.aovs);
    if (passes > 1) {
        throw cli::UsageError("--aov: allowed with one pass; not with --passes, --target-rmse or --time-limit");
    }
    return aovs;
}

std::vector<std::string> aov_channels(const std::vector<Aov>& aovs) {
    std::vector<std::string> channels;
    channels.reserve(aovs.size());
    for (const Aov aov : aovs) channels.push_back(name_of(aov) + ".Y");
    return channels;
}

std::vector<float> aov_values(const std::vector<Aov>& aovs, const film::Film& strip) {
    std::vector<float> values;
    values.reserve(aovs.size() * strip.costs().size());
    for (const glm::vec2& cost : strip.costs()) {
        for (const Aov aov : aovs) values.push_back(value_of(aov, cost));
    }
    return values;
}

CostPicture::CostPicture(Aov aov, const film::Rect& window) : aov_(aov), window_(window) {
    const auto divide_up = [](int a, int b) { return (a + b - 1) / b; };
    block_ = divide_up(std::max(window.width(), window.height()), kLongestCostSide);
    width_ = divide_up(window.width(), block_);
    height_ = divide_up(window.height(), block_);
    sum_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0);
}

void CostPicture::add(const film::Film& strip) {
    const film::Rect& w = strip.window();
    auto cost = strip.costs().begin();
    for (int y = w.y0 - window_.y0; y < w.y1 - window_.y0; ++y) {
        double* row = &sum_[static_cast<std::size_t>(y / block_) * static_cast<std::size_t>(width_)];
        for (int x = 0; x < w.width(); ++x) {
            const double value = static_cast<double>(value_of(aov_, *cost++));
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
    sheet.scale = image::difference_scale(std::clamp(width_, 320, 640), top, meaning(aov_));
    const double pixels = 1.0 * window_.width() * window_.height();
    sheet.caption = fmt::format("{}x{} pixels, mean {:.4g}, largest {:.4g}{}", window_.width(), window_.height(),
                                whole_sum_ / pixels, largest,
                                block_ > 1 ? fmt::format("; each dot the mean of {0}x{0} pixels", block_) : "");
    return image::compose(sheet);
}

}  // namespace strata::tools::job
