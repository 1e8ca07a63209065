// Pictures of what pixels cost, to look at.
#pragma once

#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/image/canvas.h"
#include "src/integrate/channels.h"

namespace strata::tools::job {

// A small picture of a large one's costs, gathered strip by strip: blocks of k x k pixels are averaged, with the least
// k that leaves no side longer than kLongestCostSide.
inline constexpr int kLongestCostSide = 1920;

class CostPicture {
  public:
    // The first component of an AOV; strips hold the values that it is one of.
    CostPicture(const integrate::ChannelSet::Entry& aov, const film::Rect& window);

    void add(const film::Film& strip);

    // In false colour, with a scale that begins at 0.
    image::Canvas draw(const std::string& title) const;

  private:
    integrate::ChannelSet::Entry aov_;
    film::Rect window_;
    int block_;
    int width_, height_;  // of the small picture
    std::vector<double> sum_;
    double whole_sum_ = 0;
};

}  // namespace strata::tools::job
