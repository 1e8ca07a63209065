#include "tools/explain/pilot.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "src/render/render.h"

namespace strata::tools {

namespace {

constexpr std::int64_t kLeastRuns = 256;
constexpr std::int64_t kLongestRun = 32;  // as wide as a render's tiles

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class Constant final : public render::ImageFunction {
  public:
    void evaluate(const render::SampleBatch& /*samples*/, std::span<glm::vec3> radiance,
                  render::Counters& /*counters*/) const override {
        std::ranges::fill(radiance, glm::vec3(0.5f));
    }
};

// Pixels or cells, in runs of neighbours.
std::vector<glm::ivec2> choose_owners(const render::Window& window, std::int64_t wanted) {
    const std::int64_t total = std::int64_t{1} * window.width() * window.height();
    wanted = std::clamp<std::int64_t>(wanted, 1, total);
    const std::int64_t length = std::clamp<std::int64_t>(wanted / kLeastRuns, 1, kLongestRun);
    const std::int64_t runs = std::max<std::int64_t>(1, wanted / length);
    constexpr double kGoldenRatio = 0.6180339887498949;
    std::vector<glm::ivec2> owners;
    for (std::int64_t run = 0; run < runs; ++run) {
        const std::int64_t begin = total * run / runs, end = total * (run + 1) / runs;
        const std::int64_t count = std::min(length, end - begin);
        const double place = std::fmod(kGoldenRatio * (static_cast<double>(run) + 0.5), 1.0);
        const auto first = begin + static_cast<std::int64_t>(place * static_cast<double>(end - begin - count + 1));
        for (std::int64_t i = first; i < first + count; ++i) {
            owners.emplace_back(window.x0 + static_cast<int>(i % window.width()),
                                window.y0 + static_cast<int>(i / window.width()));
        }
    }
    return owners;
}

}  // namespace

PilotRun run_pilot(const render::ImageFunction& image, const render::EstimatorSettings& settings,
                   const render::Window& owners, std::uint64_t rays) {
    render::EstimatorSettings coarse = settings;
    coarse.N = std::min(settings.N, kPilotN);
    const render::Estimator estimator(coarse);
    const auto samples = static_cast<std::size_t>(estimator.sample_count());
    const std::vector<glm::ivec2> chosen = choose_owners(owners, static_cast<std::int64_t>(rays / samples));
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
