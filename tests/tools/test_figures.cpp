#include "tools/figures/figure.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <set>

#include "src/estimate/estimator.h"
#include "src/scene/keys.h"
#include "src/scene/validate.h"
#include "tests/image/scratch_folder.h"
#include "tools/figures/films.h"
#include "tools/figures/page.h"
#include "tools/figures/surface_areas.h"
#include "tools/figures/wheel_rows.h"
#include "tools/job/picture_job.h"

namespace {

using namespace strata::tools::figures;
using namespace strata;

constexpr int kN = 10;
constexpr int kOrder = 4;

// The cubic B-spline's distribution, centred, by its piecewise polynomials: no code in common with src/filter.
double cubic_cdf(double x) {
    const auto lower = [](double t) {  // t = x + 2 in [0,2]
        if (t <= 0) return 0.0;
        if (t <= 1) return std::pow(t, 4) / 24;
        const double s = t - 1;
        return 1.0 / 24 + s / 6 + s * s / 4 + s * s * s / 6 - std::pow(s, 4) / 8;
    };
    return x <= 0 ? lower(x + 2) : 1 - lower(2 - x);
}

std::vector<estimate::ProbeSample> samples_of(scene::EstimatorKind kind, int pixel) {
    estimate::EstimatorSettings settings;
    settings.kind = kind;
    settings.N = kN;
    settings.m = kOrder;
    return estimate::Estimator(settings).probe_samples(pixel, 3 * pixel + 1);
}

// Chi-squared of the samples' weight over kBins bins of equal probability.
double chi_squared(const std::vector<double>& y, int bins) {
    std::vector<double> counts(static_cast<std::size_t>(bins));
    for (const double p : y) counts[static_cast<std::size_t>(std::clamp(p, 0.0, 1 - 1e-12) * bins)] += 1;
    const double expected = static_cast<double>(y.size()) / bins;
    double sum = 0;
    for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
    return sum;
}

struct Harmonic {
    double amplitude;
    double pitches;  // phase, counter-clockwise, in spoke pitches
};

// The spokes' first harmonic around the wheel, between hub and rim: a Fourier sum over pixel centres.
Harmonic spoke_harmonic(const scene::Scene& scene) {
    const int side = scene.film.width;
    const image::Picture picture = tools::job::render_picture({scene, {0, 0, side, side}}, {}).picture;
    std::complex<double> sum = 0;
    int count = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double right = (x + 0.5 - 0.5 * side) / (0.5 * side), up = (0.5 * side - y - 0.5) / (0.5 * side);
            const double radius = std::hypot(right, up);
            if (radius < 0.45 || radius > 0.75) continue;
            const double angle = std::atan2(up, right);
            // Dark spokes count.
            const double dark = 1 - static_cast<double>(picture.rgb[3 * static_cast<std::size_t>(y * side + x)]);
            sum += dark * std::polar(1.0, scene.wheel.spokes * angle);
            ++count;
        }
    }
    sum /= count;
    return {std::abs(sum), std::arg(sum) / (2 * std::numbers::pi)};
}

Harmonic harmonic(double spoke_Hz, int time_order, int frame) {
    return spoke_harmonic(wheel_scene(spoke_Hz, time_order, frame, 96));
}

// The nearest way round, in (-1/2, 1/2].
double turned(const Harmonic& from, const Harmonic& to) {
    const double difference = to.pitches - from.pitches;
    return difference - std::round(difference);
}

}  // namespace

TEST_CASE("stratified samples of figure 3: one in each of the N x N strata of probability, in every pixel") {
    for (int pixel = 0; pixel < 50; ++pixel) {
        const auto samples = samples_of(scene::EstimatorKind::stratified, pixel);
        REQUIRE(samples.size() == kN * kN);
        std::set<std::pair<int, int>> strata;
        for (const estimate::ProbeSample& sample : samples) {
            CHECK(sample.weight == doctest::Approx(1.0 / (kN * kN)));
            strata.insert({static_cast<int>(cubic_cdf(sample.u) * kN), static_cast<int>(cubic_cdf(sample.v) * kN)});
        }
        // Float samples within rounding of a stratum's edge may fall on its other side.
        CHECK(strata.size() >= kN * kN - 1);
    }
}

TEST_CASE("samples by density obey the cubic's distribution: chi-squared at a level of 1e-6 an axis, 60 pixels") {
    constexpr int kBins = 50;
    const double limit = boost::math::quantile(boost::math::chi_squared(kBins - 1), 1 - 1e-6);
    for (const auto kind :
         {scene::EstimatorKind::stratified, scene::EstimatorKind::random, scene::EstimatorKind::sobol}) {
        std::vector<double> u, v;
        for (int pixel = 0; pixel < 60; ++pixel) {
            for (const estimate::ProbeSample& sample : samples_of(kind, pixel)) {
                u.push_back(cubic_cdf(sample.u));
                v.push_back(cubic_cdf(sample.v));
            }
        }
        const double of_u = chi_squared(u, kBins), of_v = chi_squared(v, kBins);
        INFO("chi-squared ", of_u, " and ", of_v, ", limit ", limit);
        CHECK(of_u < limit);
        CHECK(of_v < limit);
        // The same samples against a tent's distribution: the test has power.
        std::vector<double> wrong;
        for (const double y : u) wrong.push_back(y * y * (3 - 2 * y));
        CHECK(chi_squared(wrong, kBins) > limit);
    }
}

TEST_CASE("weighted samples of figure 3 spread the weight as the cubic does") {
    for (const auto kind : {scene::EstimatorKind::uniform, scene::EstimatorKind::jittered, scene::EstimatorKind::shared,
                            scene::EstimatorKind::shared_sobol}) {
        const double edge = 1.2;  // between cells of the grid
        double inside = 0, total = 0, variance = 0;
        for (int pixel = 0; pixel < 40; ++pixel) {
            for (const estimate::ProbeSample& sample : samples_of(kind, pixel)) {
                total += sample.weight;
                if (std::abs(sample.u) < edge) inside += sample.weight;
                variance += sample.weight * sample.u * sample.u;
            }
        }
        CHECK(total == doctest::Approx(40));
        CHECK(inside / total == doctest::Approx(cubic_cdf(edge) - cubic_cdf(-edge)).epsilon(0.02));
        CHECK(variance / total == doctest::Approx(kOrder / 12.0).epsilon(0.05));
    }
}

TEST_CASE("under the box fast spokes keep 0.29 of their contrast and turn backwards; under the cubic 0.007 is left") {
    // At rest the shutter blurs nothing: the contrast that the filters in time start from.
    scene::Scene still = wheel_scene(kSlow_Hz, 1, 0, 96);
    still.shutter.open_s = 0;
    const double whole = spoke_harmonic(still).amplitude;
    REQUIRE(whole > 0.2);
    CHECK(wheel_gain(kFast_Hz, 1) == doctest::Approx(0.2885).epsilon(0.001));
    CHECK(wheel_gain(kFast_Hz, 4) == doctest::Approx(0.00693).epsilon(0.002));

    const Harmonic box = harmonic(kFast_Hz, 1, 0), box_next = harmonic(kFast_Hz, 1, 1);
    CHECK(box.amplitude / whole == doctest::Approx(0.2885).epsilon(0.02));
    CHECK(box_next.amplitude / whole == doctest::Approx(0.2885).epsilon(0.02));
    // 23/25 of a pitch counter-clockwise is 2/25 clockwise.
    CHECK(turned(box, box_next) == doctest::Approx(-0.08).epsilon(0.05));

    const double cubic = harmonic(kFast_Hz, 4, 0).amplitude / whole;
    INFO("the cubic leaves ", cubic);
    CHECK(cubic == doctest::Approx(0.00693).epsilon(0.3));
}

TEST_CASE("slow spokes are seen to turn as they do, under either filter") {
    for (const int time_order : {1, 4}) {
        const Harmonic first = harmonic(kSlow_Hz, time_order, 0), next = harmonic(kSlow_Hz, time_order, 1);
        CHECK(turned(first, next) == doctest::Approx(0.08).epsilon(0.05));
        CHECK(first.amplitude > 0.2 * std::pow(0.98, time_order));
    }
}

TEST_CASE("every figure tells all its parameters, at every size") {
    for (const Size size : {Size::small, Size::paper, Size::large}) {
        for (const Figure& figure : all_figures()) {
            const Plan plan = figure.plan(size);
            CHECK(plan.number == figure.number);
            const auto record = record_of(plan, size);
            for (const char* key :
                 {"title", "caption", "chosen", "command", "size", "version", "simd_target", "shown"}) {
                CHECK_FALSE(record.at(key).empty());
            }
            CHECK(record.dump().find('\n') == std::string::npos);
            CHECK((record.at("parts").empty() == figure.is_plot));
            for (std::size_t i = 0; i < plan.parts.size(); ++i) {
                scene::Scene scene = plan.parts[i].scene;
                CHECK_NOTHROW(scene::validate(scene));
                const auto& keys = record.at("parts")[i].at("scene");
                for (const scene::Section& section : scene::describe(scene)) {
                    for (const scene::Key& key : section.keys) CHECK(keys.contains(key.full_name()) == key.matters);
                }
                CHECK(keys.at("sampling.N") == scene.sampling.N);
                CHECK(keys.at("film.width") == scene.film.width);
            }
        }
    }
}

TEST_CASE(
    "files of all figures have names of their own, and every compared picture is shown with an alternative text") {
    std::map<std::string, int> names;
    for (const Figure& figure : all_figures()) {
        const Plan plan = figure.plan(Size::paper);
        std::set<std::string> shown;
        for (const Shown& file : plan.shown) {
            ++names[file.file];
            shown.insert(file.file);
            CHECK(file.alt.size() > 15);
        }
        for (const Part& part : plan.parts) ++names[part.file];
        for (const std::string& file : plan.data) ++names[file];
        for (const Comparison& pair : plan.comparisons)
            CHECK((shown.contains(pair.left) && shown.contains(pair.right)));
    }
    for (const auto& [name, count] : names) {
        INFO(name);
        CHECK(count == 1);
        CHECK(name.starts_with("figure-"));
    }
}

TEST_CASE("the areas of figures 6 and 7 lie inside the surface's frame and show the same part at every size") {
    const scene::Scene paper = surface_scene(Size::paper);
    for (const auto area : {detail_of_figure_6, detail_of_figure_7}) {
        const film::Rect reference = area(Size::paper);
        for (const Size size : {Size::small, Size::paper, Size::large}) {
            const scene::Scene scene = surface_scene(size);
            const film::Rect w = area(size);
            CHECK((w.x0 >= 0 && w.y0 >= 0 && w.x1 <= scene.film.width && w.y1 <= scene.film.height));
            CHECK(w.x0 * paper.film.width == reference.x0 * scene.film.width);
            CHECK(w.width() * paper.film.width == reference.width() * scene.film.width);
        }
    }
}

TEST_CASE("the page holds the records, whatever their texts, and refers to nothing outside its folder") {
    std::vector<nlohmann::ordered_json> records;
    for (const Figure& figure : all_figures()) records.push_back(record_of(figure.plan(Size::small), Size::small));
    records[0]["caption"] = "</script><script>alert(1)</script> {{version}}";
    const nlohmann::ordered_json film = film_record(films(Size::small).front());
    const std::string page = page_of(records, {film});
    const std::string before = "id=\"records\">", after = "</script>";
    const std::size_t begin = page.find(before) + before.size(), end = page.find(after, begin);
    const auto held = nlohmann::ordered_json::parse(page.substr(begin, end - begin));
    CHECK(held["figures"] == records);
    CHECK(held["films"] == nlohmann::ordered_json::array({film}));
    for (const char* remote : {"http://", "https://", "src=\"/", "href=\"/", "@import", "url("}) {
        INFO(remote);
        CHECK(page.find(remote) == std::string::npos);
    }
    const ScratchFolder empty;
    CHECK_THROWS(write_page(empty.path()));
}

TEST_CASE("every file to be seen has an alternative text, and what is compared is shown") {
    for (const Figure& figure : all_figures()) {
        const Plan plan = figure.plan(Size::small);
        std::set<std::string> shown;
        for (const Shown& file : plan.shown) {
            CHECK(file.alt.size() >= 10);
            shown.insert(file.file);
        }
        for (const Comparison& pair : plan.comparisons)
            CHECK((shown.contains(pair.left) && shown.contains(pair.right)));
    }
}
