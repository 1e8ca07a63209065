#include <algorithm>
#include <charconv>
#include <cmath>

#include "noise/bounds.h"
#include "noise/fbm.h"
#include "noise/float_error.h"
#include "noise/noise.h"
#include "src/library/noise/spans.h"
#include "src/noise.h"

namespace strata {

namespace {

constexpr double kLeastFrequency = 1e-30, kMostFrequency = 1e15, kMostAmplitude = 1e30;
constexpr double kMostCells = 0x1p51;  // places in cells are doubles, which tell halves of them there

std::string text(double x) {
    std::array<char, 32> characters{};
    const auto end = std::to_chars(characters.data(), characters.data() + characters.size(), x).ptr;
    return {characters.data(), end};
}

[[noreturn]] void refuse(const std::string& place, double value, const std::string& allowed) {
    throw Error(place + ": out of range (" + text(value) + "), allowed: " + allowed);
}

void check_parameters(const FbmParameters& parameters) {
    if (parameters.octaves < 1 || parameters.octaves > noise::kMaxOctaves) {
        refuse("octaves", parameters.octaves, "1 to " + std::to_string(noise::kMaxOctaves));
    }
    const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
    if (!positive(parameters.lacunarity)) refuse("lacunarity", parameters.lacunarity, "a finite number above 0");
    if (!positive(parameters.frequency)) refuse("frequency", parameters.frequency, "a finite number above 0");
    if (!std::isfinite(parameters.gain)) refuse("gain", parameters.gain, "a finite number");
    if (!std::isfinite(parameters.amplitude)) refuse("amplitude", parameters.amplitude, "a finite number");
}

void check_octaves(const std::vector<noise::Octave>& octaves) {
    for (std::size_t k = 0; k < octaves.size(); ++k) {
        const std::string place = "octave " + std::to_string(k);
        const double w = octaves[k].frequency, a = std::abs(octaves[k].amplitude);
        if (!(w >= kLeastFrequency && w <= kMostFrequency)) refuse(place + ": frequency", w, "1e-30 to 1e15");
        if (!(a <= kMostAmplitude)) refuse(place + ": amplitude", a, "up to 1e30");
        if (!(a * w <= kMostAmplitude)) refuse(place + ": amplitude * frequency", a * w, "up to 1e30");
        if (!(a * w * w <= kMostAmplitude)) refuse(place + ": amplitude * frequency^2", a * w * w, "up to 1e30");
    }
}

// The roundings of the certificates' own sums of up to 32 terms, and what products of two roundings add to their first
// orders, are far less than this part of them.
constexpr double kUp = 1.0 + 0x1p-12;

// Numbers below the least normal float may be taken for 0: so many terms, each times at most the noise's second
// derivative, 15.
constexpr double kUnderflow = 0x1p-126 * 15 * 2 * noise::kMaxOctaves;

}  // namespace

template <std::size_t D>
struct Fbm<D>::Octaves {
    FbmParameters parameters;
    std::vector<noise::Octave> octaves;
    double greatest_frequency = 0.0;

    void check(const FbmPoints<D>& points) const {
        for (std::size_t a = 0; a < D; ++a) {
            const double x = points.origin[a];
            if (greatest_frequency * std::abs(x) < kMostCells) continue;
            refuse("origin[" + std::to_string(a) + "]", x,
                   "less than 2^51 cells of the finest octave away from 0, " + text(kMostCells / greatest_frequency));
        }
    }
};

template <std::size_t D>
Fbm<D>::Fbm(const FbmParameters& parameters) {
    check_parameters(parameters);
    octaves_ = std::make_unique<Octaves>(
        Octaves{parameters, noise::make_octaves({parameters.octaves, parameters.lacunarity, parameters.gain,
                                                 parameters.amplitude, parameters.frequency, parameters.seed})});
    check_octaves(octaves_->octaves);
    for (const noise::Octave& octave : octaves_->octaves) {
        octaves_->greatest_frequency = std::max(octaves_->greatest_frequency, octave.frequency);
    }
}

template <std::size_t D>
Fbm<D>::~Fbm() = default;
template <std::size_t D>
Fbm<D>::Fbm(const Fbm& other) : octaves_(std::make_unique<Octaves>(*other.octaves_)) {}
template <std::size_t D>
Fbm<D>& Fbm<D>::operator=(const Fbm& other) {
    if (this != &other) octaves_ = std::make_unique<Octaves>(*other.octaves_);
    return *this;
}
template <std::size_t D>
Fbm<D>::Fbm(Fbm&& other) noexcept = default;
template <std::size_t D>
Fbm<D>& Fbm<D>::operator=(Fbm&& other) noexcept = default;

template <std::size_t D>
const FbmParameters& Fbm<D>::parameters() const {
    return octaves_->parameters;
}

template <std::size_t D>
void Fbm<D>::values(const FbmPoints<D>& points, std::span<float> value) const {
    octaves_->check(points);
    check_spans<D>(points.offset, value);
    noise::fbm_value(octaves_->octaves, points.origin, points.offset, value);
}

template <std::size_t D>
void Fbm<D>::gradients(const FbmPoints<D>& points, std::span<float> value, const Gradients<D>& gradient) const {
    octaves_->check(points);
    check_spans<D>(points.offset, value, gradient.axis);
    noise::fbm_gradient(octaves_->octaves, points.origin, points.offset, value, noise::GradientSpans<D>{gradient.axis});
}

template <std::size_t D>
void Fbm<D>::hessians(const FbmPoints<D>& points, std::span<float> value, const Gradients<D>& gradient,
                      const Hessians<D>& hessian) const {
    octaves_->check(points);
    check_spans<D>(points.offset, value, gradient.axis, hessian.entry);
    noise::fbm_hessian(octaves_->octaves, points.origin, points.offset, value, noise::GradientSpans<D>{gradient.axis},
                       noise::HessianSpans<D>{hessian.entry});
}

template <std::size_t D>
Bounds Fbm<D>::bounds() const {
    const noise::NoiseBounds& of_noise = noise::kNoiseBounds<D>;
    Bounds sum{};
    for (const noise::Octave& octave : octaves_->octaves) {
        const double a = std::abs(octave.amplitude), w = octave.frequency;
        sum.value += a * of_noise.value;
        sum.gradient += a * w * of_noise.gradient;
        sum.second += a * w * w * of_noise.second;
        sum.third += a * w * w * w * of_noise.third;
    }
    return {kUp * sum.value, kUp * sum.gradient, kUp * sum.second, kUp * sum.third};
}

// With e = 2^-24. A place: w, the product, the fraction at the origin and their sum are rounded to float, e (3 |w
// offset| + 2) cells on each axis, and w origin + o twice to double before; a change of place of d cells changes a
// derivative of order j by the bound of order j + 1 times |d|, that of order 2 too, since the largest value of a
// symmetric trilinear form on unit vectors is one with all three alike (Banach 1938). Then the noise's own evaluation
// (noise/float_error.h), the rounding of the octave's factor, and of the product and the sum of each octave so far.
template <std::size_t D>
Rounding Fbm<D>::rounding(double largest_origin, double largest_offset) const {
    constexpr double kFloat = 0x1p-24, kDouble = 0x1p-53;
    const noise::NoiseBounds& of_noise = noise::kNoiseBounds<D>;
    const noise::FloatErrors& errors = noise::kFloatErrors<D>;
    const std::array<double, 4> largest = {of_noise.value, of_noise.gradient, of_noise.second, of_noise.third};
    const std::array<double, 3> own = {errors.value, errors.gradient_axis, errors.hessian_entry};
    const double roundings = kFloat * static_cast<double>(2 + octaves_->octaves.size());
    std::array<double, 3> sum = {kUnderflow, kUnderflow, kUnderflow};
    for (const noise::Octave& octave : octaves_->octaves) {
        const double w = octave.frequency;
        const double shift =
            kFloat * (3.0 * w * std::abs(largest_offset) + 2.0) + 2.0 * kDouble * (w * std::abs(largest_origin) + 1.0);
        double factor = kUp * std::abs(octave.amplitude);
        for (std::size_t order = 0; order < 3; ++order, factor *= w) {
            const double moved = std::sqrt(static_cast<double>(D)) * shift * largest[order + 1];
            sum[order] += factor * (own[order] + moved + roundings * (largest[order] + moved));
        }
    }
    return {sum[0], sum[1], sum[2]};
}

template class Fbm<2>;
template class Fbm<3>;

}  // namespace strata
