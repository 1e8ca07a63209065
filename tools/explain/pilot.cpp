#include "tools/explain/pilot.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>
#include <utility>
#include <vector>

#include "src/render/render.h"

namespace strata::tools::explain {

namespace {

constexpr double kLeastBlocks = 128;  // if there are as many pixels: fewer tell little of how they differ
constexpr double kBlockSamples = 32;  // a side: enough to share what a render's samples share
constexpr int kTile = 32;             // pixels: a render's tiles

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class Constant final : public integrate::ImageFunction {
  public:
    void evaluate(const integrate::SampleBatch& /*samples*/, const integrate::SampleOut& out,
                  integrate::Counters& /*counters*/) const override {
        std::ranges::fill(out.radiance, glm::vec3(0.5f));
    }
};

// Where a block of that side begins in the n-th of equal parts of [from, to).
int block_start(int from, int to, std::int64_t n, std::int64_t parts, int side, double place) {
    const double part = static_cast<double>(to - from) / static_cast<double>(parts);
    const double first = from + part * static_cast<double>(n) + place * std::max(0.0, part - side);
    return std::clamp(static_cast<int>(first), from, std::max(from, to - side));
}

struct Blocks {
    std::vector<film::Rect> windows;  // row by row
    int columns = 1;
};

// The whole window.
Blocks all_blocks(const film::Rect& window, int side) {
    Blocks blocks{{}, (window.width() + side - 1) / side};
    for (int y = window.y0; y < window.y1; y += side) {
        for (int x = window.x0; x < window.x1; x += side) {
            blocks.windows.push_back({x, y, std::min(x + side, window.x1), std::min(y + side, window.y1)});
        }
    }
    return blocks;
}

// About `wanted` pixels or cells in square blocks, one in each of nearly square parts of the window.
Blocks choose_blocks(const film::Rect& window, std::int64_t wanted, int samples_a_side) {
    const double total = 1.0 * window.width() * window.height();
    const double pixels = std::clamp(static_cast<double>(wanted), 1.0, total);
    const double widest = std::clamp(kBlockSamples / samples_a_side, 1.0, 1.0 * kTile);
    const int side = static_cast<int>(std::clamp(std::sqrt(pixels / kLeastBlocks), 1.0, widest));
    if (pixels >= total) return all_blocks(window, side);
    const double count = std::max(1.0, pixels / (side * side)), part = std::sqrt(total / count);
    const auto columns = std::max<std::int64_t>(1, std::llround(window.width() / part));
    const auto rows = std::max<std::int64_t>(1, static_cast<std::int64_t>(count / static_cast<double>(columns)));
    constexpr double kGoldenRatio = 0.6180339887498949, kSecondRatio = 0.7548776662466927;
    Blocks blocks{{}, static_cast<int>(columns)};
    for (std::int64_t i = 0; i < rows * columns; ++i) {
        const double n = static_cast<double>(i) + 0.5;
        const int x0 = block_start(window.x0, window.x1, i % columns, columns, side, std::fmod(n * kGoldenRatio, 1.0));
        const int y0 = block_start(window.y0, window.y1, i / columns, rows, side, std::fmod(n * kSecondRatio, 1.0));
        blocks.windows.push_back({x0, y0, std::min(x0 + side, window.x1), std::min(y0 + side, window.y1)});
    }
    return blocks;
}

std::vector<glm::ivec2> pixels_of(const film::Rect& window) {
    std::vector<glm::ivec2> pixels;
    for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x) pixels.emplace_back(x, y);
    }
    return pixels;
}

}  // namespace

// The cells of the screen, with a handful of samples each, that the samples of a square of pixels touch, over the
// number of samples. Samples of a pixel are spread over the filter's support: at the square's border they touch cells
// that the next square touches again.
double cells_a_sample(const estimate::Estimator& estimator, int columns, int rows) {
    if (estimator.shared()) return 1.0;
    estimate::SampleSet set;
    estimator.pixel_samples(pixels_of({0, 0, columns, rows}), set);
    const double cells_a_pixel = std::exp2(std::floor(std::log2(std::max(1, estimator.settings().N) / 2.0)));
    std::set<std::pair<int, int>> cells;
    for (std::size_t i = 0; i < set.u.size(); ++i) {
        cells.emplace(static_cast<int>(std::floor(set.u[i] * cells_a_pixel)),
                      static_cast<int>(std::floor(set.v[i] * cells_a_pixel)));
    }
    return static_cast<double>(cells.size()) / static_cast<double>(set.u.size());
}

PilotRun run_pilot(const integrate::ImageFunction& image, const estimate::EstimatorSettings& settings,
                   const film::Rect& owners, std::uint64_t rays) {
    const estimate::Estimator estimator(settings);
    const auto samples = static_cast<std::size_t>(estimator.sample_count());
    const Blocks blocks = choose_blocks(owners, static_cast<std::int64_t>(rays / samples), settings.N);
    const std::size_t batch = std::max<std::size_t>(1, image.batch_samples() / samples);
    PilotRun pilot;
    pilot.columns = blocks.columns;
    const film::Rect& block = blocks.windows.front();
    const int tile_columns = std::min(static_cast<int>(batch), kTile);
    const int tile_rows = std::clamp(static_cast<int>(batch) / kTile, 1, kTile);
    pilot.shared_correction =
        cells_a_sample(estimator, std::min(tile_columns, owners.width()), std::min(tile_rows, owners.height())) /
        cells_a_sample(estimator, block.width(), block.height());
    estimate::SampleSet set;
    std::vector<glm::vec3> radiance;
    for (const film::Rect& window : blocks.windows) {
        const std::vector<glm::ivec2> chosen = pixels_of(window);
        integrate::Counters& counters = pilot.by_block.emplace_back();
        for (std::size_t first = 0; first < chosen.size(); first += batch) {
            const auto part = std::span(chosen).subspan(first, std::min(batch, chosen.size() - first));
            if (estimator.shared()) {
                estimator.cell_samples(part, set);
            } else {
                estimator.pixel_samples(part, set);
            }
            radiance.resize(set.u.size());
            const double start = cpu_now();
            image.evaluate(set.batch(0, radiance.size()), radiance, counters);
            pilot.cpu_seconds += cpu_now() - start;
            counters.rays += radiance.size();
        }
        pilot.counters += counters;
    }
    return pilot;
}

double estimator_seconds_a_ray(const estimate::EstimatorSettings& settings) {
    constexpr int kSamples = 1 << 15;
    const int side =
        std::max(1, static_cast<int>(std::sqrt(static_cast<double>(kSamples) / (settings.N * settings.N))));
    render::RenderOptions options;
    options.threads = 1;
    const render::RenderResult result =
        render::render(Constant(), estimate::Estimator(settings), {0, 0, side, side}, options);
    return result.cpu_seconds / static_cast<double>(result.counters.rays);
}

}  // namespace strata::tools::explain
