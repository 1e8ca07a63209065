#include "tools/converge/reference.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "src/integrate/make_image.h"
#include "src/render/progressive.h"
#include "src/sample/counter_hash.h"
#include "tools/converge/truth.h"

namespace strata::tools::converge {

namespace {

// Passes of the scene's seed that no picture will ever have.
constexpr std::uint64_t kFirstHalf = 0x5265666572656e63u;

film::Rect frame_of(const scene::Scene& scene) { return {0, 0, scene.film.width, scene.film.height}; }

void finish(Reference& reference, const std::vector<glm::dvec3>& pixels) {
    double squares = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const glm::dvec3& pixel = pixels[i];
        for (int c = 0; c < 3; ++c)
            reference.picture.rgb[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(pixel[c]);
        reference.grey.push_back((pixel.x + pixel.y + pixel.z) / 3);
        squares += glm::dot(pixel, pixel) / 3;
    }
    reference.root_mean_square = std::sqrt(squares / static_cast<double>(pixels.size()));
}

Reference of_truth(const scene::Scene& scene, int m, const Truth& truth) {
    Reference reference;
    reference.m = m;
    reference.picture = image::make_picture(scene.film.width, scene.film.height);
    reference.exact = true;
    reference.error = truth.error;
    reference.how = truth.how;
    std::vector<glm::dvec3> pixels;
    for (const double grey : truth.grey) pixels.emplace_back(grey);
    finish(reference, pixels);
    return reference;
}

}  // namespace

bool has_exact_reference(const scene::Scene& scene, int m) {
    // One pixel far from everything tells whether there is an answer, in no time.
    return has_exact_picture(scene) && exact_picture(scene, m, {0, 0, 1, 1}).has_value();
}

std::optional<Reference> make_reference(const scene::Scene& scene, int m, int N, int threads,
                                        const parallel::CancelToken& cancel) {
    const film::Rect window = frame_of(scene);
    if (const auto truth = exact_picture(scene, m, window)) return of_truth(scene, m, *truth);
    const auto image_function = integrate::make_image(scene);
    estimate::EstimatorSettings settings = estimate::estimator_settings(scene);
    settings.kind = scene::EstimatorKind::shared_sobol;
    settings.N = N;
    settings.m = m;
    const std::uint64_t seed = settings.seed;
    std::array<film::Film, 2> half;
    for (std::uint64_t i = 0; i < 2; ++i) {
        settings.seed = sample::pass_seed(seed, kFirstHalf + i);
        render::RenderOptions options;
        options.threads = threads;
        options.cancel = &cancel;
        render::ProgressiveResult result =
            render::render_progressively(*image_function, settings, window, {.passes = kPassesOfAHalf}, options);
        if (result.render.cancelled) return std::nullopt;
        half[i] = std::move(result.render.film);
    }
    Reference reference;
    reference.m = m;
    reference.picture = image::make_picture(window.width(), window.height());
    std::vector<glm::dvec3> pixels;
    double squares = 0;
    for (std::size_t i = 0; i < half[0].pixels().size(); ++i) {
        const glm::dvec3 a(half[0].pixels()[i]);
        const glm::dvec3 b(half[1].pixels()[i]);
        pixels.push_back(0.5 * (a + b));
        squares += glm::dot(a - b, a - b) / 3;
    }
    reference.error = 0.5 * std::sqrt(squares / static_cast<double>(pixels.size()));
    reference.how = fmt::format(
        "the engine: two halves of {0} renders with {1} x {1} shared-sobol samples a pixel, seeds of their own",
        kPassesOfAHalf, N);
    finish(reference, pixels);
    return reference;
}

}  // namespace strata::tools::converge
