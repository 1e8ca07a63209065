// What pixels cost, beside the picture: channels of its EXR, and pictures to look at.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/image/canvas.h"
#include "src/image/metadata.h"
#include "tools/cli/scene_argument.h"

namespace strata::tools::job {

// In the order of their channels.
enum class Aov { evals, steps };

std::string name_of(Aov aov);

// "steps,evals" and the like, in the order of their channels, each once. Throws UsageError for another word.
std::vector<Aov> parse_aovs(const std::string& text);

// Those of --aov, empty if not given, else those that the picture recorded. Throws UsageError, for several passes too.
std::vector<Aov> aovs_of(const std::string& typed, const cli::LoadedScene& loaded, int passes);

// Channels of an EXR: "evals.Y", "steps.Y".
std::vector<std::string> aov_channels(const std::vector<Aov>& aovs);

// The values of the strip's pixels, one after the other as many as there are `aovs`.
std::vector<float> aov_values(const std::vector<Aov>& aovs, const film::Film& strip);

// A small picture of a large one's costs, gathered strip by strip: blocks of k x k pixels are averaged, with the least
// k that leaves no side longer than kLongestCostSide.
inline constexpr int kLongestCostSide = 1920;

class CostPicture {
  public:
    CostPicture(Aov aov, const film::Rect& window);

    Aov aov() const { return aov_; }
    void add(const film::Film& strip);

    // In false colour, with a scale that begins at 0.
    image::Canvas draw(const std::string& title) const;

  private:
    Aov aov_;
    film::Rect window_;
    int block_;
    int width_, height_;  // of the small picture
    std::vector<double> sum_;
    double whole_sum_ = 0;
};

}  // namespace strata::tools::job
