#include "src/estimate/estimator.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "src/sample/counter_hash.h"
#include "src/sample/strata.h"
#include "src/scene/needs.h"

namespace strata::estimate {

using scene::Placement;

namespace {

// A power of two, so that a pixel of such weights alone has the bits of a plain mean. Below every weight of
// consequence, yet its product with the least float is still a double: 2^(-900-149) > 2^-1074.
constexpr double kVanishedWeight = 0x1p-900;

std::uint64_t seed_of_frame(std::uint64_t seed, int frame) {
    if (frame == 0) return seed;
    return noise::mix64(noise::mix64(seed) + sample::kCounterStride * static_cast<std::uint64_t>(frame));
}

}  // namespace

EstimatorSettings estimator_settings(const scene::Scene& scene) {
    EstimatorSettings settings;
    settings.kind = scene.sampling.estimator;
    settings.N = scene.sampling.N;
    settings.m = scene.sampling.m;
    settings.time_order = scene.sampling.time_order;
    settings.seed = seed_of_frame(scene.sampling.seed, scene.shutter.frame);
    settings.shutter = {scene.shutter.time_s(), scene.shutter.open_s};
    // Where nothing moves any time does: no times are drawn.
    if (!scene::needs_time_samples(scene)) settings.shutter = {settings.shutter.middle_s(), 0.0};
    return settings;
}

Estimator::Estimator(const EstimatorSettings& settings)
    : settings_(settings),
      row_(scene::row_of(settings.kind)),
      sample_count_(row_.is_single ? 1 : settings.N * settings.N),
      pattern_(row_.pattern, settings.N) {
    assert(settings.N >= 1 && settings.m >= 1 && settings.m <= 100);
    const int N = row_.is_single ? 1 : settings.N;
    const double side = row_.placement == Placement::support_grid ? settings.m : 1;
    if (row_.is_weighed()) weights_.emplace(settings.m);
    if (row_.is_grid()) {
        for (int i = 0; i < N; ++i) grid_offset_.push_back(side * (2 * i + 1 - N) / (2.0 * N));
    }
    if (row_.placement == Placement::support_grid) {
        for (const double offset : grid_offset_) grid_weight_.push_back(weights_->at(offset + 0.5 * settings.m));
    }
    if (row_.placement == Placement::by_density) space_.emplace(settings.m);
    if (!row_.is_single && !settings.shutter.instant()) time_.emplace(settings.time_order);
}

std::uint64_t Estimator::key(const glm::ivec2& owner) const {
    return sample::cell_key(settings_.seed, owner.x, owner.y);
}

void Estimator::name_owners(std::span<const glm::ivec2> owners, SampleSet& out) const {
    out.samples_each = static_cast<std::uint32_t>(sample_count_);
    out.owner_keys.resize(owners.size());
    for (std::size_t p = 0; p < owners.size(); ++p) out.owner_keys[p] = key(owners[p]);
}

void Estimator::pixel_samples(std::span<const glm::ivec2> pixels, SampleSet& out) const {
    assert(!shared());
    const std::size_t total = pixels.size() * static_cast<std::size_t>(sample_count_);
    out.u.resize(total);
    out.v.resize(total);
    out.weight.clear();
    name_owners(pixels, out);
    switch (row_.placement) {
        case Placement::pixel_grid:
        case Placement::support_grid:
            place_grid(pixels, out);
            break;
        case Placement::jittered:
            place_jittered(pixels, out);
            break;
        case Placement::by_density:
            place_by_density(pixels, out);
            break;
        case Placement::shared:
            break;
    }
    place_times(pixels, out);
}

void Estimator::place_grid(std::span<const glm::ivec2> pixels, SampleSet& out) const {
    std::size_t i = 0;
    for (const glm::ivec2& pixel : pixels) {
        for (const double v : grid_offset_) {
            for (const double u : grid_offset_) {
                out.u[i] = pixel.x + 0.5 + u;
                out.v[i++] = pixel.y + 0.5 + v;
            }
        }
        for (const double weight_v : grid_weight_) {
            for (const double weight_u : grid_weight_) out.weight.push_back(weight_u * weight_v);
        }
    }
}

void Estimator::place_jittered(std::span<const glm::ivec2> pixels, SampleSet& out) const {
    const std::size_t n = static_cast<std::size_t>(sample_count_);
    const double m = settings_.m;
    out.scratch_x.resize(2 * n);
    const std::span<float> y_u(out.scratch_x.data(), n);
    const std::span<float> y_v(out.scratch_x.data() + n, n);
    out.weight.resize(out.u.size());
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        pattern_.positions(key(pixels[p]), y_u, y_v);
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double x_u = m * static_cast<double>(y_u[i]);
            const double x_v = m * static_cast<double>(y_v[i]);
            const double weight = weights_->at(x_u) * weights_->at(x_v);
            out.u[p * n + i] = pixels[p].x + 0.5 + (x_u - 0.5 * m);
            out.v[p * n + i] = pixels[p].y + 0.5 + (x_v - 0.5 * m);
            out.weight[p * n + i] = weight;
            sum += weight;
        }
        // Few samples far out under a high order may all have weights that vanish in a double: they count alike then,
        // but little beside another pass that knows better.
        if (!(sum > 0)) std::fill_n(out.weight.begin() + static_cast<std::ptrdiff_t>(p * n), n, kVanishedWeight);
    }
}

void Estimator::place_by_density(std::span<const glm::ivec2> pixels, SampleSet& out) const {
    const std::size_t n = static_cast<std::size_t>(sample_count_);
    const std::size_t total = out.u.size();
    out.scratch_q.resize(2 * total);
    out.scratch_x.resize(2 * total);
    const std::span<float> q(out.scratch_q);
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        pattern_.folded(key(pixels[p]), q.subspan(p * n, n), q.subspan(total + p * n, n));
    }
    space_->centred(q, out.scratch_x);
    for (std::size_t p = 0, i = 0; p < pixels.size(); ++p) {
        const double centre_u = pixels[p].x + 0.5;
        const double centre_v = pixels[p].y + 0.5;
        for (const std::size_t end = i + n; i < end; ++i) {
            out.u[i] = centre_u + static_cast<double>(out.scratch_x[i]);
            out.v[i] = centre_v + static_cast<double>(out.scratch_x[total + i]);
        }
    }
}

void Estimator::cell_samples(std::span<const glm::ivec2> cells, SampleSet& out) const {
    assert(shared());
    const std::size_t n = static_cast<std::size_t>(sample_count_);
    const std::size_t total = cells.size() * n;
    out.u.resize(total);
    out.v.resize(total);
    out.weight.clear();
    name_owners(cells, out);
    out.fraction_u.resize(total);
    out.fraction_v.resize(total);
    for (std::size_t p = 0, i = 0; p < cells.size(); ++p) {
        pattern_.positions(key(cells[p]), std::span(out.fraction_u).subspan(i, n),
                           std::span(out.fraction_v).subspan(i, n));
        for (const std::size_t end = i + n; i < end; ++i) {
            out.u[i] = cells[p].x + static_cast<double>(out.fraction_u[i]);
            out.v[i] = cells[p].y + static_cast<double>(out.fraction_v[i]);
        }
    }
    place_times(cells, out);
}

void Estimator::place_times(std::span<const glm::ivec2> owners, SampleSet& out) const {
    const std::size_t total = out.u.size();
    if (!time_) {
        out.t.assign(total, settings_.shutter.middle_s());
        return;
    }
    const std::size_t n = static_cast<std::size_t>(sample_count_);
    out.t.resize(total);
    out.scratch_q.resize(total);
    out.scratch_x.resize(total);
    out.scratch_permutation.resize(n);
    for (std::size_t p = 0; p < owners.size(); ++p) {
        const std::span<float> q = std::span(out.scratch_q).subspan(p * n, n);
        if (row_.pattern == sample::PatternKind::random) {
            sample::folded_random_times(key(owners[p]), q);
        } else {
            sample::folded_times(key(owners[p]), out.scratch_permutation, q);
        }
    }
    time_->centred(out.scratch_q, out.scratch_x);
    for (std::size_t i = 0; i < total; ++i) {
        out.t[i] = settings_.shutter.time_s(static_cast<double>(out.scratch_x[i]));
    }
}

}  // namespace strata::estimate
