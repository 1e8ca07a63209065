// Frames: how they are asked for, when motion loops, how their files are named.
#include "tools/animate/range.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shaders_cpu/wheel.h"
#include "src/trace/placement.h"
#include "tools/animate/frames.h"
#include "tools/animate/timing.h"
#include "tools/cli/errors.h"

using namespace strata::tools::animate;
using namespace strata::tools::cli;
using namespace strata;

TEST_CASE("frames are one number or first-last, both included") {
    CHECK(parse_frames("7").first() == 7);
    CHECK(parse_frames("7").last() == 7);
    CHECK(parse_frames("0-249").count() == 250);
    const auto numbers = [](const char* text) {
        const FrameList frames = parse_frames(text);
        return std::vector(frames.begin(), frames.end());
    };
    CHECK(numbers("0-10x5") == std::vector{0, 5, 10});
    CHECK(numbers("0-9x5") == std::vector{0, 5});
    CHECK(numbers("7-9,0,2,8") == std::vector{0, 2, 7, 8, 9});
    CHECK(parse_frames("0-1000000000x100000").count() == 10001);
    CHECK(parse_frames("0-100x2").step() == 2);
    CHECK(parse_frames("3").step() == 1);
    CHECK(!parse_frames("0,2,7-9").step());
    for (const char* bad : {"", "-", "-3", "3-", "3-2", "a", "1-2-3", "1,", ",1", "1,,2", "1x2", "1-3x0", "1-3x", " 1",
                            "1.5", "0-100000", "9999999999"}) {
        CAPTURE(bad);
        CHECK_THROWS_WITH_AS(parse_frames(bad), doctest::Contains("--frames"), UsageError);
    }
}

TEST_CASE("a loop's last frame is followed by its first: the surface stands as it did, the wheel looks as it did") {
    scene::Scene scene;
    int loops = 0;
    for (const double speed : {36.0, 72.0, -40.0, 4.0, 7.5, 1e-3}) {
        for (const double fps : {25.0, 24.0, 30.0, 29.97}) {
            scene.surface.spin_deg_per_s = speed;
            scene.shutter.fps = fps;
            const auto frames = loop_frames(scene);
            if (!frames) continue;
            ++loops;
            const trace::Placement placement(scene.surface);
            const glm::dmat3 start = placement.orientation(0.0), end = placement.orientation(*frames / fps);
            for (int c = 0; c < 3; ++c) CHECK(glm::distance(start[c], end[c]) < 1e-6);
        }
    }
    CHECK(loops >= 15);
    scene.surface.spin_deg_per_s = 72.0;
    scene.shutter.fps = 25.0;
    CHECK(loop_frames(scene) == 125);
    // Clouds in the wind do not come back.
    scene.clouds = {{.name = "layer", .wind_m_s = 5.0}};
    CHECK(!loop_frames(scene));
    scene.clouds.front().wind_m_s = 0.0;
    CHECK(loop_frames(scene) == 125);

    scene.image = scene::ImageKind::wheel;
    scene.wheel.turns_per_s = 1.9;
    const int frames = loop_frames(scene).value_or(0);
    CHECK(frames == 125);  // 12 * 1.9 / 25 = 0.912 = 114 / 125 of a spoke a frame
    int differing = 0;
    for (double u = 0.5; u < 64; u += 1.0) {
        for (double v = 0.5; v < 64; v += 1.0) {
            differing += shaders::wheel(scene.wheel, 64, 64, u, v, 1e-5) !=
                         shaders::wheel(scene.wheel, 64, 64, u, v, 1e-5 + frames / 25.0);
        }
    }
    CHECK(differing == 0);
}

TEST_CASE("what does not repeat has no loop; camera keys end a flight") {
    scene::Scene scene;
    CHECK(!loop_frames(scene));
    CHECK_THROWS_AS(default_frames(scene), UsageError);
    scene.surface.spin_deg_per_s = 36.0;
    scene.surface.drift = {0.0, 1.0, 0.0};
    CHECK(!loop_frames(scene));
    CHECK_THROWS_AS(default_frames(scene), UsageError);
    scene.camera.keys = {{.time_s = 0.0}, {.time_s = 2.01}};
    CHECK(default_frames(scene).count() == 52);  // 0 to 51, which is at 2.04 s
    scene.camera.keys.back().time_s = 2.0;
    CHECK(default_frames(scene).last() == 50);
    scene.camera.keys.back().time_s = 1e8;
    CHECK_THROWS_AS(default_frames(scene), UsageError);
}

TEST_CASE("'#'s in a name become the frame's number, four digits without any") {
    CHECK(FramePattern("out/a.png").path(7) == "out/a.0007.png");
    CHECK(FramePattern("a.b.exr").path(12345) == "a.b.12345.exr");
    CHECK(FramePattern("a##x.png").path(7) == "a07x.png");
    CHECK(FramePattern("######.png").path(7) == "000007.png");
    CHECK(FramePattern("a.png").text() == "a.####.png");
    CHECK(FramePattern("take #2.###.png").path(7) == "take #2.007.png");
    CHECK(FramePattern("take #2.###.png").text() == "take #2.###.png");
    CHECK(FramePattern("a#/b.png").path(7) == "a#/b.0007.png");
}

TEST_CASE("a GIF's delays are 2/100 s at least and add up to the time of the whole; video has every frame") {
    for (const char* text : {"10", "25", "24", "24000/1001", "29.97", "30", "48", "50", "59.94", "60000/1001", "60",
                             "75", "99", "100", "120", "144", "1000", "0.5"}) {
        for (const int count : {1, 2, 3, 10, 59, 60, 1001}) {
            CAPTURE(text);
            CAPTURE(count);
            const scene::Rate rate = scene::parse_fraction(text).value_or(std::stod(text));
            const FrameList frames = FrameList::range(3, 2 + count);
            const FilmTiming gif = film_timing("a.gif", frames, rate);
            int sum = 0, least = 1'000'000;
            for (std::size_t i = 0; i < gif.frames.size(); ++i) {
                // As ffmpeg rounds the times of frames.
                const auto begin = [&](std::size_t k) {
                    return static_cast<int>(std::lround(100.0 * gif.rate.seconds(static_cast<double>(k))));
                };
                const int delay = i + 1 < gif.frames.size() ? begin(i + 1) - begin(i) : *gif.last_delay_cs;
                sum += delay;
                least = std::min(least, delay);
            }
            CHECK(least >= 2);
            CHECK(std::abs(sum / 100.0 - std::max(0.02, count / static_cast<double>(rate))) <= 0.005 + 1e-9);
            CHECK(gif.seconds == doctest::Approx(sum / 100.0));
            CHECK(static_cast<int>(film_timing("a.mp4", frames, rate).frames.size()) == count);
        }
    }
    const FilmTiming slow = film_timing("a.mp4", parse_frames("0-100x2"), 25.0);
    CHECK(slow.rate == 12.5);
    CHECK(slow.seconds == 51 / 12.5);
    CHECK_THROWS_WITH_AS(check_timing("a.mp4", parse_frames("0,2,7-9"), 25.0), doctest::Contains("unevenly"),
                         UsageError);
    CHECK_THROWS_AS(check_timing("a.gif", parse_frames("0-9"), 0.001), UsageError);
    CHECK_THROWS_AS(check_timing("a.webm", parse_frames("0-9"), 1e4), UsageError);
    CHECK_NOTHROW(check_timing("a.webm", parse_frames("0-9"), 60.0));
}
