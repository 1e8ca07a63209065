// Sums of samples whose radiance spans twelve decades.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "noise/hash.h"
#include "src/render/render.h"
#include "src/scene/enum_names.h"
#include "tools/stability/case.h"

namespace strata::tools::stability {

namespace {

using scene::EstimatorKind;

render::RenderOptions one_thread() {
    render::RenderOptions options;
    options.threads = 1;
    return options;
}

constexpr float kBright = 1e6f, kDim = 1e-6f;

// 1e6 in a share of all positions, 1e-6 elsewhere, as a hash of the position decides.
class Speckle final : public integrate::ImageFunction {
  public:
    explicit Speckle(double share) : threshold_(static_cast<std::uint64_t>(share * 0x1p32)) {}

    float at(double u, double v) const {
        const auto bits = [](double x) { return static_cast<std::uint64_t>(std::llround(std::ldexp(x, 32))); };
        return (noise::mix64(noise::mix64(bits(u)) + bits(v)) >> 32) < threshold_ ? kBright : kDim;
    }

    void evaluate(const integrate::SampleBatch& samples, const integrate::SampleOut& out,
                  integrate::Counters&) const override {
        for (std::size_t i = 0; i < out.radiance.size(); ++i) {
            out.radiance[i] = glm::vec3(at(samples.u[i], samples.v[i]));
        }
    }

  private:
    std::uint64_t threshold_;
};

// The film is float: 2^-24 of a pixel for its one rounding. Before it each of n products and sums of positive numbers
// in double adds 2^-53 at most; the weights of both sides, whose sum divides, twice that.
std::vector<Row> mixed(EstimatorKind kind, const std::string& name, const Settings& settings, Random&) {
    const int pixels = settings.trials(6, 2);
    estimate::EstimatorSettings estimator_settings;
    estimator_settings.kind = kind;
    estimator_settings.N = 64;
    const estimate::Estimator estimator(estimator_settings);
    Worst in_film, in_float;
    double bound = 0.0;
    for (const double share : {0.5, 1.0 / 4096, 1e-6}) {
        const Speckle image(share);
        const render::RenderResult result = render::render(image, estimator, {0, 0, pixels, pixels}, one_thread());
        for (int y = 0; y < pixels && !settings.cancelled(); ++y) {
            for (int x = 0; x < pixels; ++x) {
                long double sum = 0.0L;
                float naive = 0.0f;
                const std::vector<estimate::ProbeSample> samples = estimator.probe_samples(x, y);
                for (const estimate::ProbeSample& s : samples) {
                    const float radiance = image.at(x + 0.5 + s.u, y + 0.5 + s.v);
                    sum += static_cast<long double>(s.weight) * static_cast<long double>(radiance);
                    naive += static_cast<float>(s.weight) * radiance;
                }
                bound = 0x1p-24 + 6.0 * static_cast<double>(samples.size()) * 0x1p-53;
                const auto where = [&] {
                    return fmt::format("share {:.3g} bright, pixel {},{}, {} samples", share, x, y, samples.size());
                };
                const auto error = [&](float found) {
                    return static_cast<double>(std::abs(static_cast<long double>(found) / sum - 1.0L));
                };
                in_film.see(error(result.film.at(x, y).r), where);
                in_float.see(error(naive), where);
            }
        }
    }
    return {check(name + ", N = 64, radiance 1e6 and 1e-6 mixed", in_film, bound, "relative"),
            information(name + ", N = 64: a film that added up in float", in_float, "relative")};
}

class Constant final : public integrate::ImageFunction {
  public:
    explicit Constant(float radiance) : radiance_(radiance) {}
    void evaluate(const integrate::SampleBatch&, const integrate::SampleOut& out, integrate::Counters&) const override {
        for (glm::vec3& r : out.radiance) r = glm::vec3(radiance_);
    }

  private:
    float radiance_;
};

// A mean of equal numbers: off by at most the roundings of the sum in double, far below half a float's step, so that
// the rounding to float gives the number back. Unless its weights sum to nothing that a double can hold.
std::vector<Row> constant(const Settings& settings, Random&) {
    Worst worst;
    for (const scene::EstimatorRow& row : scene::all_estimators()) {
        for (const int m : {1, 4, 33, 100}) {
            for (const int N : {1, 2, 64}) {
                if (settings.cancelled() || (N == 64 && (settings.fast || (m > 4 && row.is_shared())))) continue;
                estimate::EstimatorSettings chosen;
                chosen.kind = row.kind;
                chosen.N = N;
                chosen.m = m;
                const estimate::Estimator estimator(chosen);
                for (const float radiance : {kBright, kDim, 1.0f / 3.0f}) {
                    const render::RenderResult result =
                        render::render(Constant(radiance), estimator, {0, 0, 3, 2}, one_thread());
                    for (const glm::vec3& pixel : result.film.pixels()) {
                        worst.see(static_cast<double>(std::abs(pixel.g / radiance - 1.0f)), [&] {
                            return fmt::format("{}, N = {}, m = {}, radiance {:.9g}: {:.9g}", row.name, N, m, radiance,
                                               pixel.g);
                        });
                    }
                }
            }
        }
    }
    return {check("a constant picture, every estimator, m = 1..100, N = 1..64", worst, 0.0, "relative")};
}

}  // namespace

void add_sum_cases(std::vector<Case>& cases) {
    for (const EstimatorKind kind :
         {EstimatorKind::stratified, EstimatorKind::uniform, EstimatorKind::jittered, EstimatorKind::shared}) {
        const std::string name(scene::name_of(kind));
        cases.push_back({"sums", name, [=](const Settings& s, Random& r) { return mixed(kind, name, s, r); }});
    }
    cases.push_back({"sums", "constant", constant});
}

}  // namespace strata::tools::stability
