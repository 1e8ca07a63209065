#include <cstddef>

#include "src/estimate/estimator.h"

namespace strata::estimate {

namespace {

void normalise(std::vector<ProbeSample>& samples) {
    double sum = 0;
    for (const ProbeSample& sample : samples) sum += sample.weight;
    for (ProbeSample& sample : samples) sample.weight /= sum;
    std::erase_if(samples, [](const ProbeSample& sample) { return sample.weight == 0; });
}

}  // namespace

std::vector<ProbeSample> Estimator::probe_samples(int x, int y) const {
    std::vector<ProbeSample> samples;
    if (shared()) {
        samples = probe_shared(x, y);
    } else {
        SampleSet set;
        const glm::ivec2 pixel(x, y);
        pixel_samples(std::span(&pixel, 1), set);
        for (std::size_t i = 0; i < set.u.size(); ++i) {
            const double weight = set.weight.empty() ? 1.0 : set.weight[i];
            samples.push_back({set.u[i] - (x + 0.5), set.v[i] - (y + 0.5), set.t[i], weight});
        }
    }
    normalise(samples);
    return samples;
}

std::vector<ProbeSample> Estimator::probe_shared(int x, int y) const {
    std::vector<ProbeSample> samples;
    std::vector<double> weights(static_cast<std::size_t>(settings_.m));
    // The weight of a position in cell c along one axis, in the pixel `offset` to the right of c.
    const auto weight_in = [&](float fraction, int offset) {
        const int k = offset - weights_->at_fraction(fraction, weights.data());
        return k >= 0 && k < settings_.m ? weights[static_cast<std::size_t>(k)] : 0.0;
    };
    SampleSet set;
    const int reach = weights_->reach();
    for (int cell_y = y - reach; cell_y <= y + reach; ++cell_y) {
        for (int cell_x = x - reach; cell_x <= x + reach; ++cell_x) {
            const glm::ivec2 cell(cell_x, cell_y);
            cell_samples(std::span(&cell, 1), set);
            for (std::size_t i = 0; i < set.u.size(); ++i) {
                const double weight =
                    weight_in(set.fraction_u[i], x - cell_x) * weight_in(set.fraction_v[i], y - cell_y);
                if (weight > 0) samples.push_back({set.u[i] - (x + 0.5), set.v[i] - (y + 0.5), set.t[i], weight});
            }
        }
    }
    return samples;
}

}  // namespace strata::estimate
