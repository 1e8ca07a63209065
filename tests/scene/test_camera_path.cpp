// The camera over time: through its keys, without a jump in velocity, without overshoot.
#include "src/scene/camera_path.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/scene/scene_error.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tests/scene/random_scene.h"
#include "tests/support/random.h"

using namespace strata::scene;

namespace {

using strata::support::uniform;

std::array<double, 7> numbers(const Camera& camera) {
    return {camera.position.x, camera.position.y, camera.position.z, camera.look_at.x,
            camera.look_at.y,  camera.look_at.z,  camera.fov_deg};
}

Camera random_camera(Random& random, Interpolation interpolation) {
    Camera camera;
    camera.interpolation = interpolation;
    double time = uniform(random, -5.0, 5.0);
    for (auto left = 2 + random() % 7; left > 0; --left) {
        CameraKey key;
        key.time_s = time;
        time += std::exp(uniform(random, -5.0, 3.0));
        const auto point = [&] {
            return glm::dvec3(uniform(random, -9, 9), uniform(random, -9, 9), uniform(random, -9, 9));
        };
        if (random() % 4 != 0) key.position = point();
        if (random() % 4 != 0) key.look_at = point();
        if (random() % 4 != 0) key.fov_deg = uniform(random, 0.01, 179.0);
        camera.keys.push_back(key);
    }
    return camera;
}

std::string error_of(const std::string& text) {
    try {
        validate(read_scene(text, "t.toml"));
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("the camera is at each key at its time to the bit, and rests before the first and after the last") {
    Random random(1);
    for (int trial = 0; trial < 500; ++trial) {
        const Camera camera = random_camera(random, trial % 2 == 0 ? Interpolation::smooth : Interpolation::linear);
        const CameraPath path(camera);
        CHECK(path.moves());
        for (const CameraKey& key : camera.keys) {
            const Camera at = path.at(key.time_s);
            CHECK(at.position == key.position.value_or(camera.position));
            CHECK(at.look_at == key.look_at.value_or(camera.look_at));
            CHECK(at.fov_deg == key.fov_deg.value_or(camera.fov_deg));
            CHECK(at.keys.empty());
            CHECK(at.far == camera.far);
        }
        CHECK(numbers(path.at(camera.keys.front().time_s - 1e6)) == numbers(path.at(camera.keys.front().time_s)));
        CHECK(numbers(path.at(camera.keys.back().time_s + 1e6)) == numbers(path.at(camera.keys.back().time_s)));
    }
}

TEST_CASE("between two keys every coordinate stays between theirs and goes one way only") {
    Random random(2);
    for (int trial = 0; trial < 500; ++trial) {
        const Camera camera = random_camera(random, trial % 2 == 0 ? Interpolation::smooth : Interpolation::linear);
        const CameraPath path(camera);
        for (std::size_t k = 0; k + 1 < camera.keys.size(); ++k) {
            const double begin = camera.keys[k].time_s, end = camera.keys[k + 1].time_s;
            const auto from = numbers(path.at(begin)), to = numbers(path.at(end));
            auto last = from;
            for (int step = 1; step <= 40; ++step) {
                const auto here = numbers(path.at(std::min(end, begin + (end - begin) * step / 40.0)));
                for (std::size_t i = 0; i < here.size(); ++i) {
                    CHECK(here[i] >= std::min(from[i], to[i]));
                    CHECK(here[i] <= std::max(from[i], to[i]));
                    CHECK((here[i] - last[i]) * (to[i] >= from[i] ? 1.0 : -1.0) >= -1e-13);
                }
                last = here;
            }
        }
    }
}

TEST_CASE("smooth: the velocity does not jump at any key, the ends included") {
    Random random(3);
    double worst = 0.0;
    for (int trial = 0; trial < 300; ++trial) {
        const Camera camera = random_camera(random, Interpolation::smooth);
        const CameraPath path(camera);
        for (std::size_t k = 0; k < camera.keys.size(); ++k) {
            const double t = camera.keys[k].time_s;
            double gap = 1.0;
            if (k > 0) gap = std::min(gap, t - camera.keys[k - 1].time_s);
            if (k + 1 < camera.keys.size()) gap = std::min(gap, camera.keys[k + 1].time_s - t);
            const double h = 1e-4 * gap;
            const auto before = numbers(path.at(t - h)), here = numbers(path.at(t)), after = numbers(path.at(t + h));
            for (std::size_t i = 0; i < here.size(); ++i) {
                // A jump of velocity of 1 a gap would leave h / gap = 1e-4; a curvature leaves some 12 * 178 h^2.
                worst = std::max(worst, std::abs(after[i] - 2.0 * here[i] + before[i]));
            }
        }
    }
    MESSAGE("largest second difference " << worst << " (bound 4e-5)");
    CHECK(worst < 4e-5);
}

TEST_CASE("smooth: evenly spaced keys on a line are passed at even speed, linear is straight") {
    Camera camera;
    for (int k = 0; k < 6; ++k) camera.keys.push_back({.time_s = 2.0 * k, .position = glm::dvec3(3.0 * k, 0, -k)});
    for (const Interpolation interpolation : {Interpolation::smooth, Interpolation::linear}) {
        camera.interpolation = interpolation;
        const CameraPath path(camera);
        for (double t = 2.0; t <= 8.0; t += 0.13) {
            CHECK(glm::distance(path.at(t).position, 0.5 * t * glm::dvec3(3, 0, -1)) < 1e-13);
        }
    }
    CHECK(CameraPath(camera).at(0.5).position.x == doctest::Approx(0.75));
    camera.interpolation = Interpolation::smooth;
    CHECK(CameraPath(camera).at(0.5).position.x < 0.5);  // sets off from rest
}

TEST_CASE("the hull of a stretch of time holds every position in it") {
    Random random(4);
    for (int trial = 0; trial < 300; ++trial) {
        const Camera camera = random_camera(random, trial % 2 == 0 ? Interpolation::smooth : Interpolation::linear);
        const CameraPath path(camera);
        const double first = uniform(random, -6.0, 20.0), last = first + std::exp(uniform(random, -6.0, 3.0));
        const auto hull = path.position_hull({first, last});
        for (int direction = 0; direction < 10; ++direction) {
            const glm::dvec3 d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
            double farthest = -1e300;
            for (const glm::dvec3& x : hull) farthest = std::max(farthest, glm::dot(x, d));
            for (int step = 0; step <= 20; ++step) {
                CHECK(glm::dot(path.at(first + (last - first) * step / 20.0).position, d) <= farthest + 1e-12);
            }
        }
    }
}

TEST_CASE("one key is a still camera, none is the camera itself") {
    Camera camera;
    CHECK(!CameraPath(camera).moves());
    CHECK(numbers(CameraPath(camera).at(3.0)) == numbers(camera));
    camera.keys = {{.time_s = 1.0, .position = glm::dvec3(7.0)}};
    CHECK(!CameraPath(camera).moves());
    CHECK(CameraPath(camera).at(-3.0).position == glm::dvec3(7.0));
}

TEST_CASE("an eye that meets what it looks at is refused, whenever that is, and a near miss is not") {
    const std::string keys =
        "[camera]\nposition = [0, 0, 0]\n[[camera.keys]]\ntime_s = 0\nlook_at = [-1, {}, 0]\n"
        "[[camera.keys]]\ntime_s = 8\nlook_at = [1, {}, 0]\n";
    CHECK(error_of(fmt::format(fmt::runtime(keys), 0, 0)) ==
          "camera.look_at: is the same point as camera.position at 4.0 s ([0.0, 0.0, 0.0]), allowed: any other point");
    CHECK(error_of(fmt::format(fmt::runtime(keys), 0, "1e-9")).find("same point") == std::string::npos);
    CHECK(error_of(fmt::format(fmt::runtime(keys), "1e-9", "-1e-9")).find("same point") != std::string::npos);
    Random random(5);
    int met = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Camera camera = random_camera(random, trial % 2 == 0 ? Interpolation::smooth : Interpolation::linear);
        CHECK(!CameraPath(camera).meeting_time(1e-12));
        // The eye is carried to what it looks at, at some time on the way.
        const double t = uniform(random, camera.keys.front().time_s, camera.keys.back().time_s);
        const Camera at = CameraPath(camera).at(t);
        for (CameraKey& key : camera.keys) {
            key.look_at = key.look_at.value_or(camera.look_at) - at.look_at + at.position;
        }
        const auto time = CameraPath(camera).meeting_time(1e-9);
        if (time) {
            ++met;
            const Camera there = CameraPath(camera).at(*time);
            CHECK(glm::distance(there.position, there.look_at) < 2e-9);
        }
    }
    CHECK(met > 195);
}

TEST_CASE("the reach follows the camera while the shutter is open, and no further") {
    Scene scene;
    scene.camera.far = 10.0;
    scene.camera.interpolation = Interpolation::linear;
    for (int k = 0; k < 3; ++k)
        scene.camera.keys.push_back({.time_s = k * 1.0,
                                     .position = glm::dvec3(100.0 * k, 0, 0),
                                     .look_at = glm::dvec3(0, 0, 1),
                                     .fov_deg = {}});
    scene.shutter = {.fps = 1.0, .open_s = 0.5, .frame = 1};
    CHECK(reach(scene) == doctest::Approx(160.0));
    scene.sampling.time_order = 3;  // 0.5 s to 2 s
    CHECK(reach(scene) == doctest::Approx(210.0));
    scene.sampling.estimator = EstimatorKind::none;  // mid-shutter
    CHECK(reach(scene) == doctest::Approx(135.0));
    scene.surface.drift = {0.0, 0.0, 8.0};
    CHECK(noise_reach(scene) == doctest::Approx(145.0));
    CHECK(reach(scene) == doctest::Approx(135.0));
}

TEST_CASE("what is wrong with a key is told with its place") {
    const std::string first = "[camera]\n[[camera.keys]]\ntime_s = 1\n[[camera.keys]]\n";
    CHECK(error_of(first + "time_s = 1.0\n")
              .starts_with(
                  "t.toml:5:10: camera.keys[1].time_s: 1.0 is the time of the entry before it (1.0), allowed: "));
    CHECK(
        error_of(first + "time_s = 0.5\n").starts_with("t.toml:5:10: camera.keys[1].time_s: 0.5 is not 1e-06 s later"));
    CHECK(error_of(first + "time_s = 1.0000001\n").find("not 1e-06 s later") != std::string::npos);
    CHECK(error_of(first + "time_s = 'a'\n").starts_with("t.toml:5:10: camera.keys[1].time_s: wrong type"));
    CHECK(error_of(first + "time_s = nan\n").starts_with("t.toml:5:10: camera.keys[1].time_s: not a finite number"));
    CHECK(error_of(first + "positoin = [1,2,3]\n").ends_with("did you mean 'camera.keys[1].position'?"));
    CHECK(error_of(first + "position = [1,2,3]\n").starts_with("t.toml:4:1: camera.keys[1]: has no time_s"));
    CHECK(error_of(first + "time_s = 2\nfov_deg = 180\n")
              .starts_with("t.toml:6:11: camera.keys[1].fov_deg: out of range (180)"));
    CHECK(error_of(first + "time_s = 2\nposition = [1,2]\n")
              .starts_with("t.toml:6:12: camera.keys[1].position: not 3 numbers"));
    CHECK(error_of("camera.keys = [1]\n").starts_with("t.toml:1:16: camera.keys: wrong type"));
    CHECK(error_of("camera.keys = 1\n").starts_with("t.toml:1:15: camera.keys: wrong type"));
    CHECK(error_of("camera.interpolation = 'cubic'\n").find("allowed: \"smooth\", \"linear\"") != std::string::npos);
    std::string many = "camera.keys = [";
    for (int k = 0; k <= 10'000; ++k) many += fmt::format("{{time_s={}.5, position=[0.5,1.5,2.5]}},\n", k);
    CHECK(error_of(many + "]\n").starts_with("t.toml:1:15: camera.keys: too many (an array of 10001)"));
    many = "";
    for (int k = 0; k < 10'000; ++k)
        many += fmt::format("[[camera.keys]]\ntime_s = {}.5\nposition = [0.5, 1.5, 2.5]\n", k);
    CHECK(error_of(many) == "");
    Scene scene;
    scene.camera.keys = {{.time_s = 1.0, .fov_deg = 200.0}};
    CHECK_THROWS_WITH_AS(validate(scene), doctest::Contains("camera.keys[0].fov_deg: out of range"), SceneError);
    scene.camera.keys = {{.time_s = 1.0, .position = {}}, {.time_s = 1.0, .position = {}}};
    CHECK_THROWS_WITH_AS(validate(scene), doctest::Contains("camera.keys: time_s of entry 1"), SceneError);
}
