#include "src/render/meter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/integrate/make_image.h"
#include "src/render/render.h"

namespace strata::render {

namespace {

constexpr int kMeterWidth = 64;
constexpr double kMidGrey = 0.18, kNearlyBlack = 1e-3, kMostStops = 64.0;

std::vector<double> sorted_luminances(const scene::Scene& scene) {
    scene::Scene small = scene;
    small.film.width = kMeterWidth;
    small.film.height = std::clamp(kMeterWidth * scene.film.height / scene.film.width, 1, 16 * kMeterWidth);
    small.sampling.estimator = scene::EstimatorKind::stratified;
    small.sampling.N = 2;
    small.sampling.m = 1;
    const auto image = integrate::make_image(small);
    const estimate::Estimator estimator(estimate::estimator_settings(small));
    const RenderResult result = render(*image, estimator, {0, 0, small.film.width, small.film.height});
    std::vector<double> all;
    for (const glm::vec3& pixel : result.film.pixels()) {
        all.push_back(std::max(0.0, glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), glm::dvec3(pixel))));
    }
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace

double metered_stops(const scene::Scene& scene) {
    const std::vector<double> luminances = sorted_luminances(scene);
    const double high = luminances[luminances.size() * 99 / 100];
    double sum = 0.0, count = 0.0;
    for (const double luminance : luminances) {
        if (luminance <= kNearlyBlack * high) continue;
        sum += std::log2(luminance);
        ++count;
    }
    if (count == 0.0) return 0.0;
    double stops = std::log2(kMidGrey) - sum / count;
    if (scene.film.tone == scene::ToneCurve::none && high > 0.0) stops = std::min(stops, -std::log2(high));
    // Machines differ in a picture's last bits, and a tenth of a stop is not seen.
    return std::clamp(std::round(10.0 * stops) / 10.0, -kMostStops, kMostStops);
}

void take_exposure(scene::Scene& scene) {
    if (!scene.film.metered) return;
    scene.film.exposure = std::clamp(scene.film.exposure + metered_stops(scene), -kMostStops, kMostStops);
    scene.film.metered = false;
}

}  // namespace strata::render
