// Proves noise/float_error.h from above: branch and bound on the fractions of a cell with the rounding model.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "noise/bounds.h"
#include "noise/float_error.h"
#include "tests/noise/jet_model.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

// For the model's own rounding, and for float results too small to be normal (off by 2^-150 each).
constexpr double kMargin = 1e-9;

struct Certificate {
    bool holds = true;
    int boxes = 0;
    double attained = 0.0;  // largest bound at a box's middle
};

template <std::size_t D, class Output>
Certificate certify(double limit, const Output& output) {
    constexpr int kMostBoxes = 60000;
    std::array<Range, D> cell;
    cell.fill({0.0, 1.0});
    std::vector<std::array<Range, D>> open = {cell};
    Certificate result;
    while (!open.empty() && result.holds) {
        std::array<Range, D> box = open.back();
        open.pop_back();
        result.holds = ++result.boxes <= kMostBoxes;
        if (jet_error<D>(box, output) <= limit * (1.0 - kMargin)) continue;
        std::array<Range, D> middle;
        std::size_t longest = 0;
        for (std::size_t a = 0; a < D; ++a) {
            middle[a].lo = middle[a].hi = 0.5 * (box[a].lo + box[a].hi);
            if (box[a].hi - box[a].lo > box[longest].hi - box[longest].lo) longest = a;
        }
        result.attained = std::max(result.attained, jet_error<D>(middle, output));
        result.holds = result.holds && result.attained <= limit;
        std::array<Range, D> other = box;
        box[longest].hi = other[longest].lo = middle[longest].lo;
        open.push_back(box);
        open.push_back(other);
    }
    return result;
}

template <std::size_t D, class Output>
void prove(const std::string& name, double bound, double next_derivative, const Output& output) {
    // e/2 an axis, and the rounding of the fraction in double before.
    const double fraction = 0.5 * std::sqrt(static_cast<double>(D)) * next_derivative * (1.0 + 0x1p-28);
    const double limit = bound / kUnit - fraction;
    const Certificate certificate = certify<D>(limit, output);
    CHECK_MESSAGE(certificate.holds, D << "-D " << name << " is not below " << limit << " e");
    MESSAGE(D << "-D " << name << ": at most " << limit << " e + " << fraction << " e of the fraction, "
              << certificate.attained / limit << " of the former attained by the model, " << certificate.boxes
              << " boxes");
}

template <std::size_t D>
void prove_all() {
    const FloatErrors& errors = kFloatErrors<D>;
    const NoiseBounds& bounds = kNoiseBounds<D>;
    using Model = CornerModel<D>;
    prove<D>("value", errors.value, bounds.gradient, [](const Model& m) { return m.value(); });
    prove<D>("slope", errors.slope, bounds.second, [](const Model& m) { return m.slope(); });
    for (std::size_t i = 0; i < D; ++i) {
        const std::string axis(1, "xyz"[i]);
        prove<D>("d" + axis, errors.gradient_axis, bounds.second, [i](const Model& m) { return m.axis(i); });
        prove<D>("d" + axis + axis, errors.hessian_entry, bounds.third, [i](const Model& m) { return m.diagonal(i); });
        for (std::size_t j = i + 1; j < D; ++j) {
            prove<D>("d" + axis + "xyz"[j], errors.hessian_entry, bounds.third,
                     [i, j](const Model& m) { return m.mixed(i, j); });
        }
    }
}

}  // namespace

TEST_CASE("no rounding of the 2-D noise exceeds its stated error, at any fraction with any gradients") {
    prove_all<2>();
}

TEST_CASE("no rounding of the 3-D noise exceeds its stated error, at any fraction with any gradients") {
    prove_all<3>();
}
