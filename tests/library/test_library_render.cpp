#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "src/image/read.h"
#include "src/parallel/processors.h"
#include "src/strata.h"
#include "tests/image/scratch_folder.h"
#include "tests/library/errors.h"

using namespace std::chrono_literals;
using strata::RenderOptions;
using strata::Scene;

namespace {

Scene small_scene(const std::string& name, int width = 40, int height = 24) {
    Scene scene = Scene::builtin(name);
    scene.set("film.width", width);
    scene.set("film.height", height);
    scene.set("sampling.N", 2);
    return scene;
}

// Takes some seconds unless it is stopped.
Scene long_scene() {
    Scene scene = small_scene("isosurface", 320, 240);
    scene.set("sampling.N", 8);
    return scene;
}

constexpr strata::FileOptions kSingle{.exr_format = strata::ExrFormat::single};

std::string refusal(const RenderOptions& options) {
    return message_of([&] { strata::render_image(small_scene("edge"), options); });
}

}  // namespace

TEST_CASE("a picture in memory is the file's to the bit, of one pass and of several, whole and in a window") {
    const ScratchFolder folder;
    for (const char* const name : {"edge", "wheel", "hyperterrain", "planet", "winter"}) {
        const Scene scene = small_scene(name);
        for (const int passes : {1, 3}) {
            for (const bool is_part : {false, true}) {
                RenderOptions options;
                options.passes = passes;
                if (is_part) options.window = {3, 5, 20, 19};
                const strata::RenderedImage made = strata::render_image(scene, options);
                const strata::RenderReport report =
                    strata::render_file(scene, folder / "picture.exr", options, kSingle);
                const strata::image::Picture read = strata::image::read_picture(folder / "picture.exr");
                CHECK(made.image.rgb == read.rgb);
                CHECK(made.image.window == strata::Window{read.x0, read.y0, read.x1, read.y1});
                CHECK(made.image.frame_width == 40);
                CHECK(made.image.frame_height == 24);
                CHECK(made.report.rays == report.rays);
                CHECK(made.report.is_complete);
                CHECK(made.report.passes == passes);
                CHECK(report.passes == passes);
                CHECK(made.report.noise_rmse.has_value() == (passes > 1));
                CHECK(report.finished_pixels == made.image.width() * made.image.height());
            }
        }
    }
}

TEST_CASE("a window equals the frame's pixels, on any number of threads and any tile") {
    const Scene scene = small_scene("hyperterrain");
    const strata::Image whole = strata::render_image(scene).image;
    RenderOptions options;
    options.window = {7, 2, 33, 21};
    options.threads = 3;
    options.tile = 5;
    const strata::Image part = strata::render_image(scene, options).image;
    for (int y = 2; y < 21; ++y) {
        for (int x = 7; x < 33; ++x) CHECK(part.at(x, y) == whole.at(x, y));
    }
}

TEST_CASE("the reference tracer is another picture of the same scene") {
    RenderOptions options;
    options.tracer = strata::Tracer::reference;
    Scene scene = small_scene("planet", 16, 9);
    const strata::RenderReport reference = strata::render_image(scene, options).report;
    const strata::RenderReport fast = strata::render_image(scene).report;
    CHECK(reference.rays == fast.rays);
    CHECK(reference.steps > fast.steps);
}

TEST_CASE("progress grows, and a stop ends the render soon with what is finished") {
    const Scene scene = long_scene();
    std::stop_source source;
    std::vector<double> fractions;
    RenderOptions options;
    options.stop = source.get_token();
    options.on_progress = [&](const strata::Progress& progress) {
        fractions.push_back(progress.fraction);
        if (fractions.size() == 2) source.request_stop();
    };
    const strata::RenderedImage made = strata::render_image(scene, options);
    CHECK(!made.report.is_complete);
    CHECK(made.report.passes == 0);
    CHECK(made.report.finished_pixels < 320 * 240);
    CHECK(made.image.rgb.size() == 3 * 320 * 240);
    REQUIRE(fractions.size() >= 2);
    for (std::size_t i = 1; i < fractions.size(); ++i) CHECK(fractions[i] >= fractions[i - 1]);
}

TEST_CASE("a render that is to stop before it starts does nothing") {
    std::stop_source source;
    source.request_stop();
    RenderOptions options;
    options.stop = source.get_token();
    const strata::RenderReport report = strata::render_image(long_scene(), options).report;
    CHECK(!report.is_complete);
    CHECK(report.finished_pixels == 0);
}

TEST_CASE("a stopped render and one whose callback throws write nothing and keep the earlier file") {
    const ScratchFolder folder;
    const std::filesystem::path file = folder / "kept.exr";
    write_bytes(file, "earlier");
    std::stop_source source;
    for (const int passes : {1, 4}) {
        RenderOptions options;
        options.passes = passes;
        options.stop = source.get_token();
        options.on_progress = [&](const strata::Progress&) { source.request_stop(); };
        CHECK(!strata::render_file(long_scene(), file, options).is_complete);
        RenderOptions throwing;
        throwing.passes = passes;
        throwing.on_progress = [](const strata::Progress&) { throw std::out_of_range("the caller's own"); };
        CHECK_THROWS_AS(strata::render_file(long_scene(), file, throwing), std::out_of_range);
        CHECK_THROWS_AS(strata::render_image(long_scene(), throwing), std::out_of_range);
        // One call alone, at the end of a single tile: the callback's last word counts as well.
        Scene tiny = small_scene("edge", 8, 8);
        CHECK_THROWS_AS(strata::render_file(tiny, file, throwing), std::out_of_range);
    }
    CHECK(file_bytes(file) == "earlier");
    CHECK(folder.names() == std::vector<std::string>{"kept.exr"});
}

TEST_CASE("passes go on to a noise and no longer than a time") {
    RenderOptions options;
    options.target_rmse = 0.05;
    const strata::RenderReport report = strata::render_image(small_scene("checker"), options).report;
    CHECK(report.is_complete);
    CHECK(report.passes >= 4);
    REQUIRE(report.noise_rmse.has_value());
    CHECK(*report.noise_rmse <= 0.05);
    RenderOptions hurried;
    hurried.time_limit = 50ms;
    const strata::RenderReport soon = strata::render_image(small_scene("checker"), hurried).report;
    CHECK(soon.passes >= 1);
    CHECK(soon.elapsed < 60s);  // of the hour that all passes would take
}

TEST_CASE("options out of range name the option and what is allowed") {
    check_says(refusal({.window = strata::Window{0, 0, 41, 24}}), "window 0,0,41,24: allowed: ");
    check_says(refusal({.window = strata::Window{5, 5, 5, 9}}), "x0 < x1 <= 40");
    check_says(refusal({.passes = 0}), "passes: out of range (0), allowed: 1 to 1000000");
    check_says(refusal({.target_rmse = -1}), "target_rmse: out of range (-1)");
    check_says(refusal({.target_rmse = std::numeric_limits<double>::quiet_NaN()}), "target_rmse: ");
    check_says(refusal({.time_limit = -1s}), "time_limit: out of range (-1 s)");
    check_says(refusal({.threads = -1}), "threads: out of range (-1), allowed: 0 to 1024");
    check_says(refusal({.tile = 0}), "tile: out of range (0), allowed: 1 to 1024");
    Scene scene = small_scene("edge");
    scene.set("sampling.estimator", "none");
    check_says(message_of([&] { strata::render_image(scene, {.passes = 2}); }),
               "passes: passes of the estimator 'none'");
    check_says(message_of([&] { strata::render_image(scene, {.target_rmse = 0.1}); }), "target_rmse: passes of");
}

TEST_CASE("passes that memory holds only without the weights of shared samples are refused") {
    // Between the 50 bytes a pixel of estimators without random weights and the 90 of those that have them.
    const double rows = static_cast<double>(strata::parallel::available_memory_bytes()) / 70 / 65536;
    if (rows > 65536) return;  // no picture is large enough for this machine
    Scene scene = small_scene("edge", 65536, static_cast<int>(rows));
    scene.set("sampling.estimator", "shared-sobol");
    std::stop_source stopped;
    stopped.request_stop();
    check_says(message_of([&] { strata::render_image(scene, {.passes = 2, .stop = stopped.get_token()}); }),
               "GB of memory");
}

TEST_CASE("files that cannot be written are refused before the render, with their path") {
    const ScratchFolder folder;
    const auto refused = [&](const std::filesystem::path& file) {
        RenderOptions options;
        options.on_progress = [](const strata::Progress&) { FAIL("the render began"); };
        const auto message = [&] {
            return message_of([&] { strata::render_file(small_scene("edge"), file, options); });
        };
        const std::string of_one_pass = message();
        options.passes = 2;
        CHECK(message() == of_one_pass);
        return of_one_pass;
    };
    check_says(refused(folder / "a.gif"), "a.gif");
    check_says(refused(folder / "no such folder" / "a.exr"), "no such folder");
    check_says(refused(folder.path()), folder.path().string());
    check_says(refused("-"), "standard output");
    CHECK(folder.names().empty());
}

TEST_CASE("renders in several threads at once are each as alone") {
    const std::vector<std::string> names = {"planet", "terrain", "zoneplate"};
    std::vector<strata::Image> alone;
    for (const std::string& name : names) alone.push_back(strata::render_image(small_scene(name)).image);
    std::vector<strata::Image> together(names.size());
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < names.size(); ++i) {
            threads.emplace_back([&, i] { together[i] = strata::render_image(small_scene(names[i])).image; });
        }
    }
    for (std::size_t i = 0; i < names.size(); ++i) CHECK(together[i].rgb == alone[i].rgb);
}
