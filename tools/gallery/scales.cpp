#include "tools/gallery/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/image/colour_out.h"
#include "src/image/compare.h"
#include "src/image/sheet.h"

namespace strata::tools::gallery {

namespace {

constexpr int kPanelWidth = 640;  // pixels, about
constexpr int kSeeds = 2;

// (1,...,1), k of them, convolved m times with itself, over k^m.
std::vector<double> narrow_weights(int k, int m) {
    std::vector<double> weights{1.0};
    for (int i = 0; i < m; ++i) {
        std::vector<double> wider(weights.size() + static_cast<std::size_t>(k) - 1, 0.0);
        for (std::size_t j = 0; j < wider.size(); ++j)
            for (std::size_t l = 0; l < static_cast<std::size_t>(k); ++l)
                if (j >= l && j - l < weights.size()) wider[j] += weights[j - l] / k;
        weights = std::move(wider);
    }
    return weights;
}

// Each row of three floats a pixel, pixels `step` floats apart, from `from` values to the coarse ones.
void reduce_line(const float* from, std::size_t step, int count, int k, const std::vector<double>& weights, float* to,
                 std::size_t to_step) {
    for (int x = 0; x < count; ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (std::size_t i = 0; i < weights.size(); ++i)
                sum += weights[i] * from[(static_cast<std::size_t>(x * k) + i) * step + c];
            to[static_cast<std::size_t>(x) * to_step + c] = static_cast<float>(sum);
        }
    }
}

image::Picture mean(const image::Picture& a, const image::Picture& b) {
    image::Picture sum = a;
    for (std::size_t i = 0; i < sum.rgb.size(); ++i) sum.rgb[i] = 0.5f * (a.rgb[i] + b.rgb[i]);
    return sum;
}

image::Picture cut(const image::Picture& from, const film::Rect& window) {
    image::Picture part{from.frame_width, from.frame_height, window.x0, window.y0, window.x1, window.y1, {}};
    for (int y = window.y0; y < window.y1; ++y) {
        const std::size_t row = 3 * (static_cast<std::size_t>(y - from.y0) * static_cast<std::size_t>(from.width()) +
                                     static_cast<std::size_t>(window.x0 - from.x0));
        const auto begin = from.rgb.begin() + static_cast<std::ptrdiff_t>(row);
        part.rgb.insert(part.rgb.end(), begin, begin + 3 * window.width());
    }
    return part;
}

job::PictureJob job_at(scene::Scene scene, const film::Rect& place, int k, int seed) {
    scene.film.width *= k;
    scene.film.height *= k;
    scene.sampling.estimator = scene::EstimatorKind::stratified;
    if (scene.sampling.m % 2 == 0) scene.sampling.m = 3;
    scene.sampling.N = std::max(1, scene.sampling.N / k);
    scene.sampling.seed += static_cast<std::uint64_t>(seed);
    const film::Rect window = fine_window(place, k, scene.sampling.m);
    return {std::move(scene), window};
}

}  // namespace

film::Rect fine_window(const film::Rect& coarse, int k, int m) {
    const int margin = (m - 1) * (k - 1) / 2;
    return {coarse.x0 * k - margin, coarse.y0 * k - margin, coarse.x1 * k + margin, coarse.y1 * k + margin};
}

image::Picture reduced(const image::Picture& fine, const film::Rect& coarse, int k, int m) {
    const std::vector<double> weights = narrow_weights(k, m);
    const auto width = static_cast<std::size_t>(coarse.width()), height = static_cast<std::size_t>(fine.height());
    std::vector<float> narrow(3 * width * height);
    for (std::size_t y = 0; y < height; ++y) {
        reduce_line(&fine.rgb[3 * y * static_cast<std::size_t>(fine.width())], 3, coarse.width(), k, weights,
                    &narrow[3 * y * width], 3);
    }
    image::Picture small{fine.frame_width / k, fine.frame_height / k, coarse.x0, coarse.y0, coarse.x1, coarse.y1, {}};
    small.rgb.resize(3 * small.pixels());
    for (std::size_t x = 0; x < width; ++x)
        reduce_line(&narrow[3 * x], 3 * width, coarse.height(), k, weights, &small.rgb[3 * x], 3 * width);
    return small;
}

std::vector<Scale> compare_scales(const scene::Scene& scene, const film::Rect& place, const std::vector<int>& factors,
                                  job::Batch& batch) {
    for (const int k : factors)
        for (int seed = 0; seed < kSeeds; ++seed) batch.expect(job_at(scene, place, k, seed));
    std::vector<Scale> scales;
    for (const int k : factors) {
        Scale scale;
        scale.factor = k;
        scale.width = k * scene.film.width;
        scale.height = k * scene.film.height;
        std::vector<image::Picture> small;
        for (int seed = 0; seed < kSeeds; ++seed) {
            const job::PictureJob job = job_at(scene, place, k, seed);
            auto rendered = batch.render(job);
            if (!rendered) return {};
            small.push_back(reduced(rendered->picture, place, k, job.scene.sampling.m));
            if (seed == 0)
                scale.picture = cut(rendered->picture, {place.x0 * k, place.y0 * k, place.x1 * k, place.y1 * k});
        }
        scale.small = mean(small[0], small[1]);
        // Two of variance s^2 differ by 2 s^2 in the mean square, and their mean has s^2 / 2.
        scale.noise = image::compare(small[0], small[1]).rmse / 2;
        scales.push_back(std::move(scale));
        Scale& last = scales.back();
        last.difference = image::compare(last.small, scales.front().small).rmse;
        last.expected = scales.size() == 1 ? 0.0 : std::hypot(last.noise, scales.front().noise);
    }
    return scales;
}

std::optional<bool> is_same_by_one_thread(const scene::Scene& scene, const film::Rect& place, const Scale& scale,
                                          bool quiet, const parallel::CancelToken& cancel) {
    const int k = scale.factor;
    job::Batch batch(1, quiet, cancel);
    const job::PictureJob job = job_at(scene, place, k, 0);
    batch.expect(job);
    const auto rendered = batch.render(job);
    if (!rendered) return std::nullopt;
    batch.clear_progress();
    const film::Rect inner{place.x0 * k, place.y0 * k, place.x1 * k, place.y1 * k};
    return cut(rendered->picture, inner).rgb == scale.picture.rgb;
}

image::Canvas draw_scales(const std::vector<Scale>& scales, const scene::Scene& scene, const std::string& caption) {
    const image::ColourOut colour = image::colour_out(scene.film);
    const int coarse_width = scales.front().small.width();
    const int largest = std::ranges::max(scales, {}, &Scale::factor).factor;
    const int zoom = std::max(largest, kPanelWidth / coarse_width);
    image::Sheet sheet;
    sheet.title = "One place at several sizes";
    sheet.row_labels = {"as rendered", "as pixels of the first"};
    sheet.rows.resize(2);
    for (const Scale& scale : scales) {
        sheet.column_labels.push_back(fmt::format("a frame of {} × {}", scale.width, scale.height));
        sheet.rows[0].push_back(
            {image::magnify(image::to_canvas(scale.picture, colour), std::max(1, zoom / scale.factor)), "", false});
        std::string note =
            scale.factor == scales.front().factor
                ? fmt::format("own sampling error {:#.2g}", scale.noise)
                : fmt::format("RMSE {:#.2g}; {:#.2g} by sampling alone", scale.difference, scale.expected);
        sheet.rows[1].push_back({image::magnify(image::to_canvas(scale.small, colour), zoom), std::move(note), false});
    }
    sheet.caption = caption;
    return image::compose(sheet);
}

}  // namespace strata::tools::gallery
