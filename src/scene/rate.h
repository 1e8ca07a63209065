// Frame rates: decimals such as 25, and fractions such as television's 24000/1001.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace strata::scene {

// numerator / denominator frames a second. Of a fraction both are whole numbers without a common factor; a decimal is
// over 1, so that the time of a frame is rounded once either way.
class Rate {
  public:
    constexpr Rate(double frames_per_s) : numerator_(frames_per_s) {}  // NOLINT: a number is a rate
    // Both positive.
    static Rate fraction(long long numerator, long long denominator);

    constexpr operator double() const { return numerator_ / denominator_; }
    constexpr double numerator() const { return numerator_; }
    constexpr double denominator() const { return denominator_; }

    // When a frame begins, or how long so many frames last: the double next to the exact value (up to 10^9 frames).
    constexpr double seconds(double frames) const { return frames * denominator_ / numerator_; }

    // The rate at which every step-th of the frames takes the same time.
    Rate every(int step) const;

    // "24000/1001", or a number as scene files have it.
    std::string text() const;

  private:
    double numerator_;
    double denominator_ = 1.0;
};

// Whole numbers of a fraction, at most: products with the number of a frame stay exact.
inline constexpr long long kMostOfFraction = 1'000'000;

// "24000/1001" without spaces. Nothing for other text.
std::optional<Rate> parse_fraction(std::string_view text);

}  // namespace strata::scene
