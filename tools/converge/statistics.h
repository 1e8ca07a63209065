// What is said of errors over seeds.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace strata::tools::converge {

// sqrt(mean of squares) and half the width of its 95 % confidence interval, by Student's t over the squares (the seeds'
// mean squared errors). half_width is infinite for one value, unless `exact` says that every seed gives the same.
struct RootMean {
    double value = 0, half_width = 0;
};
RootMean root_mean(std::span<const double> squares, bool exact = false);

// Errors of a picture's pixels over several seeds, against a truth known to `truth_error`.
class PixelErrors {
  public:
    PixelErrors() = default;
    PixelErrors(int width, int height);

    // error: one a pixel, row by row.
    void add(std::span<const double> error);

    int seeds() const { return seeds_; }

    // Mean of the error over pixels and seeds.
    double mean() const;

    // How many standard errors the mean is from zero, if pixels are independent: normal for an unbiased estimator of
    // many pixels. Zero where nothing varies and nothing is wrong. At least two seeds.
    double z_of_mean(double truth_error) const;

    // Mean over pixels of the squared bias, unbiased by noise (it may come out negative): the mean product of two
    // seeds' errors in a pixel; and its standard error, if pixels are independent. At least two seeds.
    struct SquaredBias {
        double mean = 0, standard_error = 0;
    };
    SquaredBias squared_bias() const;

    // The squared bias in standard errors, one-sided: biases of opposite sign in different pixels, which cancel in the
    // mean, show here. Bounded by the square root of the number of pixels. At least two seeds.
    double z_of_squares(double truth_error) const;

    // Correlation of the errors of pixels side by side, over all such pairs, across and down, and seeds; 0 where no
    // error is.
    double neighbour_correlation() const;

  private:
    int width_ = 0, height_ = 0, seeds_ = 0;
    std::vector<double> sum_, squares_;                           // over seeds, of each pixel
    double products_ = 0, left_squares_ = 0, right_squares_ = 0;  // over pairs of neighbours
};

// The threshold of |z| (two-sided) or z (one-sided) at which one of `tests` independent tests of unbiased estimators
// fails with probability `family_level` in all (Sidak 1967).
double sidak_threshold(double family_level, std::size_t tests, bool two_sided);

}  // namespace strata::tools::converge
