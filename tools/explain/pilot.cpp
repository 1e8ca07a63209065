#include "tools/explain/pilot.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "src/render/render.h"

namespace strata::tools {

namespace {

constexpr double kLeastBlocks = 24;   // if there are as many pixels
constexpr double kBlockSamples = 32;  // a side: enough to share what a render's samples share
constexpr double kWidestBlock = 32;   // pixels: as wide as a render's tiles

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class Constant final : public integrate::ImageFunction {
  public:
    void evaluate(const integrate::SampleBatch& /*samples*/, std::span<glm::vec3> radiance,
                  integrate::Counters& /*counters*/) const override {
        std::ranges::fill(radiance, glm::vec3(0.5f));
    }
};

// Where a block of that side begins in the n-th of equal parts of [from, to).
int block_start(int from, int to, std::int64_t n, std::int64_t parts, int side, double place) {
    const double part = static_cast<double>(to - from) / static_cast<double>(parts);
    const double first = from + part * static_cast<double>(n) + place * std::max(0.0, part - side);
    return std::clamp(static_cast<int>(first), from, std::max(from, to - side));
}

// About `wanted` pixels or cells in square blocks, one in each of nearly square parts of the window.
std::vector<glm::ivec2> choose_owners(const render::Window& window, std::int64_t wanted, int samples_a_side) {
    const double total = 1.0 * window.width() * window.height();
    const double pixels = std::clamp(static_cast<double>(wanted), 1.0, total);
    const double widest = std::clamp(kBlockSamples / samples_a_side, 1.0, kWidestBlock);
    const int side = static_cast<int>(std::clamp(std::sqrt(pixels / kLeastBlocks), 1.0, widest));
    const double blocks = std::max(1.0, pixels / (side * side)), part = std::sqrt(total / blocks);
    const auto columns = std::max<std::int64_t>(1, std::llround(window.width() / part));
    const auto rows = std::max<std::int64_t>(1, static_cast<std::int64_t>(blocks / static_cast<double>(columns)));
    constexpr double kGoldenRatio = 0.6180339887498949, kSecondRatio = 0.7548776662466927;
    std::vector<glm::ivec2> owners;
    for (std::int64_t i = 0; i < rows * columns; ++i) {
        const double n = static_cast<double>(i) + 0.5;
        const int x0 = block_start(window.x0, window.x1, i % columns, columns, side, std::fmod(n * kGoldenRatio, 1.0));
        const int y0 = block_start(window.y0, window.y1, i / columns, rows, side, std::fmod(n * kSecondRatio, 1.0));
        for (int y = y0; y < std::min(y0 + side, window.y1); ++y) {
            for (int x = x0; x < std::min(x0 + side, window.x1); ++x) owners.emplace_back(x, y);
        }
    }
    return owners;
}

}  // namespace

PilotRun run_pilot(const integrate::ImageFunction& image, const render::EstimatorSettings& settings,
                   const render::Window& owners, std::uint64_t rays) {
    const render::Estimator estimator(settings);
    const auto samples = static_cast<std::size_t>(estimator.sample_count());
    const std::vector<glm::ivec2> chosen = choose_owners(owners, static_cast<std::int64_t>(rays / samples), settings.N);
    const std::size_t batch = std::max<std::size_t>(1, image.batch_samples() / samples);
    PilotRun pilot;
    render::SampleSet set;
    std::vector<glm::vec3> radiance;
    for (std::size_t first = 0; first < chosen.size(); first += batch) {
        const auto part = std::span(chosen).subspan(first, std::min(batch, chosen.size() - first));
        if (estimator.shared()) {
            estimator.cell_samples(part, set);
        } else {
            estimator.pixel_samples(part, set);
        }
        radiance.resize(set.u.size());
        const double start = cpu_now();
        image.evaluate(set.batch(0, radiance.size()), radiance, pilot.counters);
        pilot.cpu_seconds += cpu_now() - start;
        pilot.counters.rays += radiance.size();
    }
    return pilot;
}

double estimator_seconds_a_ray(const render::EstimatorSettings& settings) {
    constexpr int kSamples = 1 << 15;
    const int side =
        std::max(1, static_cast<int>(std::sqrt(static_cast<double>(kSamples) / (settings.N * settings.N))));
    render::RenderOptions options;
    options.threads = 1;
    const render::RenderResult result =
        render::render(Constant(), render::Estimator(settings), {0, 0, side, side}, options);
    return result.cpu_seconds / static_cast<double>(result.counters.rays);
}

}  // namespace strata::tools
