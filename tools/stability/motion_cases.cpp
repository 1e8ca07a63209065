// Time: an instant, a whole turn in one frame, and the distribution of sample times by order.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/filter/bspline_table.h"
#include "src/integrate/make_image.h"
#include "src/render/render.h"
#include "tools/stability/case.h"
#include "tools/stability/scene_spec.h"

namespace strata::tools::stability {

namespace {

film::Film picture(const scene::Scene& scene) {
    render::RenderOptions options;
    options.threads = 1;
    return render::render(*integrate::make_image(scene), estimate::Estimator(estimate::estimator_settings(scene)),
                          {0, 0, scene.film.width, scene.film.height}, options)
        .film;
}

// A shutter of 0 s is the instant t_k: the picture at rest, turned by hand to where the spin has brought it. The
// wheel's pattern takes t itself, so that all bits agree; the surface is turned by another formula, whose directions
// differ by a few roundings: nothing but a silhouette's hit may change, by tolerance.
std::vector<Row> instant(const Settings& settings, Random&) {
    double different = 0.0, spun = 0.0;
    const std::string size = settings.fast ? "32" : "96";
    for (const int frame : {0, 1, 7, 1000000}) {
        const std::string set = fmt::format("shutter.frame={}", frame);
        const SceneSpec wheel{"wheel",
                              {"film.width=" + size, "film.height=" + size, "shutter.open_s=0", "sampling.N=2", set}};
        const scene::Scene scene = wheel.scene();
        const film::Film film = picture(scene);
        const estimate::Estimator estimator(estimate::estimator_settings(scene));
        const auto image = integrate::make_image(scene);
        const double t = frame / scene.shutter.fps;
        for (int y = 0; y < scene.film.height; ++y) {
            for (int x = 0; x < scene.film.width; ++x) {
                double sum = 0.0;
                const auto samples = estimator.probe_samples(x, y);
                for (const estimate::ProbeSample& s : samples) {
                    const double u = x + 0.5 + s.u, v = y + 0.5 + s.v;
                    glm::vec3 radiance;
                    integrate::Counters counters;
                    image->evaluate({{&u, 1}, {&v, 1}, {&t, 1}}, std::span(&radiance, 1), counters);
                    sum += static_cast<double>(radiance.r);
                    spun += s.time_s != t;
                }
                different += static_cast<float>(sum / static_cast<double>(samples.size())) != film.at(x, y).r;
            }
        }
    }
    return {check("shutter 0: samples not at the frame's instant", spun, 0.0, "samples", "wheel, frames 0, 1, 7, 10^6"),
            check("shutter 0: pixels that differ from the instant's", different, 0.0, "pixels",
                  "wheel, frames 0, 1, 7, 10^6")};
}

// Mean and variance of the times against l s^2 / 12, and the support. One sample in each of n strata of probability:
// for a function g of the time whose total variation over the quantiles is V, the mean over the samples is within V / n
// of the integral. For t itself V = l s; for its square about the middle V = 2 (l s / 2)^2. The float table adds 1e-6 s
// at most, and time, a double, a few of its roundings.
std::vector<Row> distribution(const Settings& settings, Random& random) {
    Worst mean_error, variance_error, beyond;
    for (int order = 1; order <= 8; ++order) {
        estimate::EstimatorSettings chosen;
        chosen.N = 64;
        chosen.time_order = order;
        chosen.seed = random();
        chosen.shutter = {7 / 25.0, 0.033};
        const estimate::Estimator estimator(chosen);
        const double s = chosen.shutter.open_s, middle = 7 / 25.0 + 0.5 * s;
        const double table = (filter::kTableError + 1e-12) * s;
        for (int pixel = 0; pixel < settings.trials(40, 4); ++pixel) {
            double sum = 0.0, squares = 0.0;
            const auto samples = estimator.probe_samples(pixel, -pixel);
            const auto where = [&] {
                return fmt::format("order {}, pixel {},{}, seed {}", order, pixel, -pixel, chosen.seed);
            };
            for (const estimate::ProbeSample& sample : samples) {
                const double t = sample.time_s - middle;
                sum += t;
                squares += t * t;
                beyond.see(std::abs(t) - 0.5 * order * s, where);
            }
            const double n = static_cast<double>(samples.size());
            mean_error.see(std::abs(sum / n) / (order * s / n + table), where);
            const double half = 0.5 * order * s;
            variance_error.see(
                std::abs(squares / n - order * s * s / 12.0) / (2.0 * half * half / n + 2.0 * half * table), where);
        }
    }
    return {check("times of order l = 1..8: mean, share of its bound", mean_error, 1.0, "of bound"),
            check("times of order l = 1..8: variance l s^2 / 12, share of its bound", variance_error, 1.0, "of bound"),
            check("times of order l = 1..8: beyond the support l s", std::max(0.0, beyond.value()),
                  (filter::kTableError + 1e-12) * 0.033, "s", beyond.where())};
}

// The same draws late in a film: a time is t_k and s/2 and s (x - l/2) added up in double, three roundings of its size.
std::vector<Row> late_frames(const Settings&, Random&) {
    Worst worst;
    double bound = 0.0;
    for (const double t : {1e6 / 25.0, 1e9 / 25.0, 1e9 / 1e-3}) {
        estimate::EstimatorSettings early, late;
        early.N = late.N = 16;
        early.shutter = {0.0, 0.033};
        late.shutter = {t, 0.033};
        const auto near = estimate::Estimator(early).probe_samples(3, 4),
                   far = estimate::Estimator(late).probe_samples(3, 4);
        for (std::size_t i = 0; i < near.size(); ++i) {
            worst.see(std::abs(far[i].time_s - t - near[i].time_s) / (3.0 * 0x1p-53 * t),
                      [&] { return fmt::format("frame at {:.6g} s, sample {}", t, i); });
        }
        bound = 3.0 * 0x1p-53 * t;
    }
    return {check("late frames: sample times, share of three roundings", worst, 1.0, "of bound"),
            information("late frames: what a time can tell apart at 1e12 s, the latest", bound, "s",
                        "frame 10^9 at 0.001 frames/s")};
}

// A square column, solid, that turns once about its axis while the shutter is open, seen by level rays: at distance d
// from the axis it is met where a (|cos| + |sin|) >= d, which is always for d <= a and for a share
// acos(d / (a sqrt 2)) / (pi / 4) of the turn up to d = a sqrt 2.
double column_cover(double distance, double half_side) {
    if (distance <= half_side) return 1.0;
    const double cosine = distance / (half_side * std::numbers::sqrt2);
    return cosine >= 1.0 ? 0.0 : std::acos(cosine) / (0.25 * std::numbers::pi);
}

// Each pixel of a row: each of n samples a pixel sees the column with the cover of its own ray as probability,
// its time being uniform in the turn, in strata of space across the pixel. Strata of time and their permutation keep
// the variance of a pixel below n / (n - 1) times that of n free draws; six standard deviations are met by chance once
// in 5e8.
std::vector<Row> whole_turn(int frame, const Settings& settings, Random& random) {
    const int width = 48;
    const SceneSpec spec{"isosurface",
                         {fmt::format("film.width={}", width),
                          "film.height=1",
                          "surface.amplitude=0",
                          "surface.threshold=-1",
                          "surface.bound=box",
                          "surface.bound_size=[1,4,1]",
                          "camera.position=[0,0,-6]",
                          "camera.look_at=[0,0,0]",
                          "camera.fov_deg=32",
                          "sun.intensity=0",
                          "sky.zenith=[1,1,1]",
                          "sky.horizon=[1,1,1]",
                          "material.low=[0,0,0]",
                          "material.high=[0,0,0]",
                          "material.steep=[0,0,0]",
                          "surface.spin_axis=[0,1,0]",
                          "surface.spin_deg_per_s=9000",
                          "shutter.fps=25",
                          "shutter.open_s=0.04",
                          fmt::format("shutter.frame={}", frame),
                          fmt::format("sampling.N={}", settings.fast ? 8 : 24),
                          "sampling.m=1",
                          fmt::format("sampling.seed={}", random() >> 2)}};
    const scene::Scene scene = spec.scene();
    const film::Film film = picture(scene);
    const double n = scene.sampling.N * scene.sampling.N;
    const double pixel = 2.0 * std::tan(0.5 * scene.camera.fov_deg / 180.0 * std::numbers::pi) / width;
    Worst worst;
    for (int x = 0; x < width; ++x) {
        double cover = 0.0;
        constexpr int kPoints = 2000;
        for (int i = 0; i < kPoints; ++i) {
            const double tangent = std::abs((x + (i + 0.5) / kPoints - 0.5 * width) * pixel);
            cover += column_cover(6.0 * tangent / std::sqrt(1.0 + tangent * tangent), 1.0) / kPoints;
        }
        const double bound = 6.0 * std::sqrt(cover * (1.0 - cover) / (n - 1.0)) + 1e-6;
        worst.see(std::abs(1.0 - static_cast<double>(film.at(x, 0).r) - cover) / bound, [&] {
            return fmt::format("pixel {}: cover {:.6f} for {:.6f}", x, 1.0 - static_cast<double>(film.at(x, 0).r),
                               cover);
        });
    }
    return {check(fmt::format("one full turn in frame {}: the column's cover, share of six sigma", frame), worst, 1.0,
                  "of bound")};
}

// The wheel, a whole number of spokes a shutter: every pixel between hub and rim is 1 - spoke_fill on average. Over all
// of them the mean of M pixels of n samples errs by less than six of its standard deviations.
std::vector<Row> even_disc(const Settings& settings, Random& random) {
    const SceneSpec spec{
        "wheel",
        {"film.width=64", "film.height=64", "wheel.spokes=12", "wheel.turns_per_s=25", "wheel.spoke_fill=0.4",
         "shutter.fps=25", "shutter.open_s=0.04", "sampling.m=1", fmt::format("sampling.N={}", settings.fast ? 4 : 16),
         fmt::format("sampling.seed={}", random() >> 2)}};
    const scene::Scene scene = spec.scene();
    const film::Film film = picture(scene);
    const double n = scene.sampling.N * scene.sampling.N, variance = 0.4 * 0.6 / (n - 1.0);
    Worst worst;
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            // Wholly between hub and rim, whose radii are 0.15 and 0.8 of half the frame.
            const double radius = std::hypot(x - 31.5, y - 31.5) / 32.0, corner = std::numbers::sqrt2 / 64.0;
            if (radius - corner < 0.15 || radius + corner > 0.8) continue;
            const double error = static_cast<double>(film.at(x, y).r) - 0.6;
            sum += error;
            count += 1.0;
            worst.see(std::abs(error) / (7.0 * std::sqrt(variance)),
                      [&] { return fmt::format("pixel {},{}: {:.6f}", x, y, 0.6 + error); });
        }
    }
    return {check("the wheel, one full turn in a frame: mean of the disc", std::abs(sum / count),
                  6.0 * std::sqrt(variance / count), "radiance",
                  fmt::format("{} pixels of {} samples, expected 0.6", count, n)),
            check("the wheel, one full turn in a frame: any pixel, share of seven sigma", worst, 1.0, "of bound")};
}

}  // namespace

void add_motion_cases(std::vector<Case>& cases) {
    cases.push_back({"motion", "shutter 0", instant});
    cases.push_back({"motion", "orders", distribution});
    cases.push_back({"motion", "late frames", late_frames});
    for (const int frame : {3, 1000000}) {
        cases.push_back({"motion", fmt::format("whole turn of a column, frame {}", frame),
                         [=](const Settings& s, Random& r) { return whole_turn(frame, s, r); }});
    }
    cases.push_back({"motion", "whole turn of the wheel", even_disc});
}

}  // namespace strata::tools::stability
