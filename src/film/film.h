// The rendered part of a picture, and which of its pixels are done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace strata::film {

// Half-open: pixels [x0,x1) x [y0,y1) of the frame, y down.
struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool operator==(const Rect&) const = default;
};

// What a film holds of each pixel beside its radiance.
struct FilmExtras {
    std::size_t channel_values = 0;  // of a pixel
    bool weights = false;
};

class Film {
  public:
    Film() = default;
    explicit Film(const Rect& window, const FilmExtras& extras = {});

    const Rect& window() const { return window_; }

    // Linear radiance, row by row from the window's top left; 0 where a pixel is not finished.
    const std::vector<glm::vec3>& pixels() const { return pixels_; }
    const glm::vec3& at(int x, int y) const { return pixels_[index(x, y)]; }

    bool finished(int x, int y) const { return finished_[index(x, y)] != 0; }
    std::size_t finished_count() const;
    bool complete() const { return finished_count() == pixels_.size(); }

    // Sets a pixel, in frame coordinates, and marks it finished. Different pixels may be set by different threads.
    void finish(int x, int y, const glm::vec3& radiance) {
        pixels_[index(x, y)] = radiance;
        finished_[index(x, y)] = 1;
    }

    // What was asked for beside radiance, pixel by pixel: extras.channel_values floats each.
    const std::vector<float>& channels() const { return channels_; }
    std::span<const float> channels_at(int x, int y) const {
        return std::span(channels_).subspan(index(x, y) * channel_values_, channel_values_);
    }

    // May be set before or after the pixel is finished.
    std::span<float> channels_at(int x, int y) {
        return std::span(channels_).subspan(index(x, y) * channel_values_, channel_values_);
    }

    // The sum of weights that each pixel's radiance was divided by. Empty: not asked for, or all are alike.
    const std::vector<double>& weights() const { return weights_; }
    void set_weight(int x, int y, double weight) { weights_[index(x, y)] = weight; }

    // Takes over what is finished of a part, whose window lies inside this film's when it is moved by (dx,dy), and
    // which holds the same of a pixel.
    void paste(const Film& part, int dx = 0, int dy = 0);

    std::size_t bytes() const {
        return pixels_.size() * (sizeof(glm::vec3) + sizeof(std::uint8_t)) + channels_.size() * sizeof(float) +
               weights_.size() * sizeof(double);
    }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width()) +
               static_cast<std::size_t>(x - window_.x0);
    }

    Rect window_;
    std::vector<glm::vec3> pixels_;
    std::vector<std::uint8_t> finished_;
    std::size_t channel_values_ = 0;
    std::vector<float> channels_;
    std::vector<double> weights_;
};

}  // namespace strata::film
