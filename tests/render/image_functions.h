// Cheap image functions with known integrals, for the tests of estimators and rendering.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>

#include "src/integrate/image_function.h"
#include "src/scene/scene.h"

namespace strata::render::testing {

// Any function of (u, v, t); counts a hit a sample, so that counters can be checked.
template <typename Function>
class Formula : public integrate::ImageFunction {
  public:
    explicit Formula(Function function) : function_(std::move(function)) {}

    void evaluate(const integrate::SampleBatch& samples, const integrate::SampleOut& out,
                  integrate::Counters& counters) const override {
        counters.hits += samples.u.size();
        for (std::size_t i = 0; i < samples.u.size(); ++i) {
            out.radiance[i] = function_(samples.u[i], samples.v[i], samples.t[i]);
        }
    }

  private:
    Function function_;
};

inline auto constant(const glm::vec3& value) {
    return Formula([value](double, double, double) { return value; });
}

inline auto ramp() {
    return Formula([](double u, double v, double) { return glm::vec3(u, v, 2 * u - 3 * v); });
}

// A zone plate in red, a slanted edge in green, both moving, and time in blue.
inline auto busy() {
    return Formula([](double u, double v, double t) {
        const double rings = 0.5 + 0.5 * std::cos(0.05 * (u * u + v * v) + 40 * t);
        return glm::vec3(rings, 3 * u + 7 * v > 150 + 900 * t ? 1.0 : 0.0, 1000 * t);
    });
}

// cos(2 pi (fu u + fv v + ft t)) in red and its sine in green.
struct Wave {
    double fu = 0, fv = 0, ft = 0;  // cycles per px, px and second

    auto image() const {
        return Formula([*this](double u, double v, double t) {
            const double phase = 2 * std::numbers::pi * (fu * u + fv * v + ft * t);
            return glm::vec3(std::cos(phase), std::sin(phase), 1.0);
        });
    }

    // Its value under the B-splines of order m (1 px) and l (open_s), centred at (u, v, t): the transform of n_m is
    // sinc^m.
    double filtered(double u, double v, double t, int m, int l, double open_s) const {
        const double gain = std::pow(sinc(fu) * sinc(fv), m) * std::pow(sinc(ft * open_s), l);
        return gain * std::cos(2 * std::numbers::pi * (fu * u + fv * v + ft * t));
    }

    static double sinc(double f) {
        const double x = std::numbers::pi * f;
        return x == 0 ? 1 : std::sin(x) / x;
    }
};

}  // namespace strata::render::testing
