#include "src/image/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "src/image/difference.h"
#include "src/image/image_error.h"

using namespace strata::image;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Picture random_picture(std::mt19937& random, int width, int height, float top) {
    std::uniform_real_distribution<float> value(0.0f, top);
    Picture picture = make_picture(width, height);
    for (float& v : picture.rgb) v = value(random);
    return picture;
}

// The definitions spelled out in long double, sorting everything.
struct Oracle {
    std::vector<long double> d, r;

    void add(float value, float reference) {
        if (std::isnan(value) || std::isnan(reference) || std::isinf(value) || std::isinf(reference)) return;
        d.push_back(std::fabs(static_cast<long double>(value) - static_cast<long double>(reference)));
        r.push_back(reference);
    }
    static long double rms(const std::vector<long double>& values) {
        long double sum = 0;
        for (const long double v : values) sum += v * v / static_cast<long double>(values.size());
        return std::sqrt(sum);
    }
    // The least of the values that is >= at least 99 % of them.
    long double percentile99() {
        std::sort(d.begin(), d.end());
        for (const long double v : d) {
            const auto covered = std::upper_bound(d.begin(), d.end(), v) - d.begin();
            if (100 * covered >= 99 * static_cast<std::ptrdiff_t>(d.size())) return v;
        }
        return -1;
    }
};

double relative_error(double value, long double expected) {
    if (expected == 0) return std::fabs(value);
    return static_cast<double>(std::fabs((value - expected) / expected));
}

}  // namespace

TEST_CASE("errors are those of their definitions, for ordinary, huge, tiny and broken values") {
    std::mt19937 random(5);
    double worst = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const int width = std::uniform_int_distribution(1, 40)(random);
        const int height = std::uniform_int_distribution(1, 40)(random);
        const float top = std::vector<float>{1.0f, 1e30f, 1e-20f, 50.0f}[trial % 4];
        Picture a = random_picture(random, width, height, top), b = random_picture(random, width, height, top);
        if (trial % 3 == 0) b.rgb = a.rgb, b.rgb[a.rgb.size() / 2] += top;
        if (trial % 5 == 0) a.rgb[0] = kNaN, b.rgb[1] = kInfinity, a.rgb[2] = -kInfinity;
        Oracle all, channel[3];
        for (std::size_t i = 0; i < a.rgb.size(); ++i) {
            all.add(a.rgb[i], b.rgb[i]);
            channel[i % 3].add(a.rgb[i], b.rgb[i]);
        }
        if (channel[0].d.empty() || channel[1].d.empty() || channel[2].d.empty()) continue;
        const Comparison c = compare(a, b);
        CHECK(c.not_finite == a.rgb.size() - all.d.size());
        worst = std::max(worst, relative_error(c.rmse, Oracle::rms(all.d)));
        worst = std::max(worst, relative_error(c.relative_rmse, Oracle::rms(all.d) / Oracle::rms(all.r)));
        for (int k = 0; k < 3; ++k)
            worst = std::max(worst, relative_error(c.channel_rmse[k], Oracle::rms(channel[k].d)));
        CHECK(c.max_abs == static_cast<double>(*std::max_element(all.d.begin(), all.d.end())));
        CHECK(c.percentile99 == static_cast<double>(all.percentile99()));
    }
    // Sums of up to 4800 positive terms: at most their count in roundings.
    const double bound = 4800 * std::numeric_limits<double>::epsilon();
    CHECK(worst <= bound);
    MESSAGE("relative error of means, observed / bound: ", worst / bound);
}

TEST_CASE("a picture compared with itself differs by nothing, even a black one") {
    std::mt19937 random(6);
    for (const Picture& picture : {random_picture(random, 9, 5, 1.0f), make_picture(4, 4)}) {
        const Comparison c = compare(picture, picture);
        CHECK(c.rmse == 0);
        CHECK(c.relative_rmse == 0);
        CHECK(c.max_abs == 0);
        CHECK(c.percentile99 == 0);
    }
    Picture grey = make_picture(4, 4);
    grey.rgb[0] = 0.5f;
    CHECK(std::isinf(compare(grey, make_picture(4, 4)).relative_rmse));
}

TEST_CASE("where nothing is finite the figures are NaN, not 0") {
    Picture broken = make_picture(3, 2);
    std::ranges::fill(broken.rgb, kNaN);
    const Comparison c = compare(broken, make_picture(3, 2));
    CHECK(c.not_finite == 18);
    for (const double value : {c.rmse, c.relative_rmse, c.max_abs, c.percentile99, c.channel_rmse[1]})
        CHECK(std::isnan(value));
}

TEST_CASE("crops compare by their pixels wherever they lie; other sizes are refused by name") {
    std::mt19937 random(7);
    const Picture whole = random_picture(random, 6, 4, 1.0f);
    Picture crop = whole;
    crop.frame_width = 100, crop.frame_height = 90, crop.x0 = 10, crop.x1 = 16, crop.y0 = 20, crop.y1 = 24;
    CHECK(compare(crop, whole).rmse == 0);
    CHECK_THROWS_WITH_AS(compare(whole, make_picture(4, 6)), doctest::Contains("6x4"), ImageError);
    CHECK_THROWS_WITH_AS(compare(whole, make_picture(4, 6)), doctest::Contains("4x6"), ImageError);
    CHECK_THROWS_WITH_AS(difference(whole, make_picture(7, 4), 1), doctest::Contains("7x4"), ImageError);
}

TEST_CASE("a difference gets lighter as it grows, and what is not finite a colour of its own") {
    Picture a = make_picture(101, 1);
    const Picture b = make_picture(101, 1);
    for (int x = 0; x < 101; ++x)
        for (int c = 0; c < 3; ++c) a.rgb[3 * x + c] = static_cast<float>(x) / 100.0f * 0.2f;
    a.rgb[3 * 100 + 1] = kNaN;
    const Canvas shown = difference(a, b, 0.2);
    const auto luma = [&](int x) {
        return 0.2126f * shown.rgb[3 * x] + 0.7152f * shown.rgb[3 * x + 1] + 0.0722f * shown.rgb[3 * x + 2];
    };
    for (int x = 1; x < 100; ++x) CHECK(luma(x) >= luma(x - 1));
    CHECK(luma(0) < 0.02f);
    CHECK(luma(99) > 0.8f);
    const std::vector<float> last(shown.rgb.end() - 3, shown.rgb.end());
    CHECK(last == std::vector<float>{kNotFiniteColour.r, kNotFiniteColour.g, kNotFiniteColour.b});
}

TEST_CASE("the scale runs through inferno's published colours, at the square root of the distance") {
    // matplotlib, _cm_listed.py, entries 0, 64, 128 and 255 of _inferno_data, in 8 bits.
    const std::pair<double, std::array<int, 3>> published[] = {
        {0.0, {0, 0, 4}}, {64 / 255.0, {87, 16, 110}}, {128 / 255.0, {188, 55, 84}}, {1.0, {252, 255, 164}}};
    for (const auto& [place, codes] : published) {
        Picture a = make_picture(1, 1);
        std::ranges::fill(a.rgb, static_cast<float>(3 * place * place));
        const Canvas shown = difference(a, make_picture(1, 1), 3);
        for (int c = 0; c < 3; ++c) CHECK(std::fabs(255.0 * shown.rgb[c] - codes[c]) <= 3);
    }
}

TEST_CASE("differences of any channel and sign count alike, and those beyond the top are its colour") {
    const Picture b = make_picture(5, 1);
    Picture a = b;
    a.rgb[0] = 0.3f, a.rgb[4] = 0.3f, a.rgb[8] = -0.3f;
    a.rgb[9] = 7.0f, a.rgb[12] = 1e30f;
    const Canvas shown = difference(a, b, 1.0);
    const auto same = [&](int x, int y) {
        return std::equal(&shown.rgb[3 * x], &shown.rgb[3 * x] + 3, &shown.rgb[3 * y]);
    };
    CHECK(same(0, 1));
    CHECK(same(0, 2));
    CHECK(same(3, 4));
    CHECK_FALSE(same(0, 3));
}

TEST_CASE("a scale's top is the next of 1, 2, 5 times a power of ten") {
    const std::pair<double, double> cases[] = {{0.037, 0.05}, {0.05, 0.05}, {0.051, 0.1}, {1, 1},
                                               {1.1, 2},      {700, 1000},  {0, 1},       {kNaN, 1}};
    for (const auto& [value, top] : cases) CHECK(scale_top(value) == doctest::Approx(top).epsilon(1e-12));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> exponent(-12, 12);
    for (int i = 0; i < 1000; ++i) {
        const double value = std::pow(10.0, exponent(random));
        CHECK(scale_top(value) >= value * (1 - 1e-12));
        CHECK(scale_top(value) <= value * 2.5 * (1 + 1e-12));
    }
}
