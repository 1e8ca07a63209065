// What a surface's channels say, held against the written definitions: cameras and turns by their own formulas.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "src/integrate/make_image.h"
#include "src/integrate/sample_view.h"

using namespace strata;
using namespace strata::integrate;

namespace {

constexpr double kRadius = 2.0;
constexpr double kDegree = std::numbers::pi / 180.0;

// A pinhole camera by the definition in src/scene/scene.h.
struct Pinhole {
    glm::dvec3 eye, forward, right, up;
    double focal_px, width, height;

    explicit Pinhole(const scene::Scene& scene, const glm::dvec3& position)
        : eye(position),
          forward(glm::normalize(scene.camera.look_at - position)),
          right(glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)))),
          up(glm::cross(right, forward)),
          focal_px(0.5 * scene.film.width / std::tan(0.5 * scene.camera.fov_deg * kDegree)),
          width(scene.film.width),
          height(scene.film.height) {}

    glm::dvec2 screen(const glm::dvec3& direction) const {
        const double scale = focal_px / glm::dot(direction, forward);
        return {0.5 * width + scale * glm::dot(direction, right), 0.5 * height - scale * glm::dot(direction, up)};
    }

    glm::dvec3 direction(double u, double v) const {
        return glm::normalize(forward * focal_px + right * (u - 0.5 * width) - up * (v - 0.5 * height));
    }
};

glm::dvec3 turned(const glm::dvec3& x, const glm::dvec3& axis, double angle) {
    const glm::dvec3 a = glm::normalize(axis);
    return x * std::cos(angle) + glm::cross(a, x) * std::sin(angle) + a * glm::dot(a, x) * (1.0 - std::cos(angle));
}

struct Batch {
    std::vector<double> u, v, t;

    SampleBatch get() const { return {u, v, t}; }
};

Batch random_batch(const scene::Scene& scene, std::size_t count, double open_s) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Batch batch;
    for (std::size_t i = 0; i < count; ++i) {
        batch.u.push_back(unit(random) * scene.film.width);
        batch.v.push_back(unit(random) * scene.film.height);
        batch.t.push_back(scene.shutter.time_s() + open_s * unit(random));
    }
    return batch;
}

struct Values {
    ChannelSet set;
    std::vector<float> values;
    std::vector<glm::vec3> radiance;

    glm::dvec3 at(std::size_t sample, const char* name) const {
        for (const ChannelSet::Entry& entry : set.entries()) {
            if (entry.channel->name != name) continue;
            glm::dvec3 value(0.0);
            for (std::size_t c = 0; c < entry.count; ++c) {
                value[static_cast<glm::length_t>(c)] =
                    static_cast<double>(values[sample * set.values() + entry.first + c]);
            }
            return value;
        }
        FAIL("no channel " << name);
        return {};
    }
};

Values evaluate(const scene::Scene& scene, const Batch& batch) {
    std::vector<const Channel*> all;
    for (const Channel& channel : all_channels()) all.push_back(&channel);
    Values result{ChannelSet(all), {}, std::vector<glm::vec3>(batch.u.size())};
    result.values.resize(batch.u.size() * result.set.values());
    Counters counters;
    make_image(scene)->evaluate(batch.get(), {result.radiance, result.set, result.values}, counters);
    return result;
}

// A ball that is almost smooth and turns, seen by a camera that flies.
scene::Scene ball() {
    scene::Scene scene;
    scene.film = {.width = 60, .height = 40};
    scene.surface.kind = solid::kKind<solid::Sphere>;
    scene.surface.shape<solid::Sphere>().radius = kRadius;
    scene.surface.scale = 1.5;
    scene.surface.origin = {0.3, -0.2, 1.0};
    scene.surface.octaves = 1;
    scene.surface.amplitude = 1e-7;
    scene.surface.rotation_deg = {20.0, 30.0, -10.0};
    scene.surface.spin_axis = {0.2, 1.0, 0.3};
    scene.surface.spin_deg_per_s = 50.0;
    scene.camera.position = {1.0, 2.0, -9.0};
    scene.camera.look_at = {0.1, 0.0, 1.0};
    scene.camera.fov_deg = 40.0;
    scene.camera.far = 60.0;
    scene.sampling.tolerance = 1e-3;
    scene.shutter.frame = 3;
    scene.shutter.open_s = 0.03;
    return scene;
}

constexpr std::size_t kCount = 600;

}  // namespace

TEST_CASE("position, normal and depths of a turning ball are those of geometry") {
    const scene::Scene scene = ball();
    const Pinhole camera(scene, scene.camera.position);
    const Batch batch = random_batch(scene, kCount, scene.shutter.open_s);
    const Values values = evaluate(scene, batch);
    const double radius = scene.surface.scale * kRadius;
    int hits = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < kCount; ++i) {
        const double distance = values.at(i, "depth").x;
        const glm::dvec3 P = values.at(i, "P"), N = values.at(i, "N");
        if (distance == SampleView::kNothing) {
            CHECK(values.at(i, "Z").x == SampleView::kNothing);
            CHECK(P == glm::dvec3(0.0));
            CHECK(N == glm::dvec3(0.0));
            continue;
        }
        ++hits;
        const glm::dvec3 expected = camera.eye + distance * camera.direction(batch.u[i], batch.v[i]);
        worst = std::max({worst, glm::length(P - expected), std::abs(glm::length(P - scene.surface.origin) - radius)});
        CHECK(std::abs(values.at(i, "Z").x - glm::dot(P - camera.eye, camera.forward)) < 1e-5);
        // A thousandth of a pixel in depth at a grazing hit turns the normal.
        CHECK(glm::length(N - glm::normalize(P - scene.surface.origin)) < 1e-3);
    }
    CHECK(hits > 100);
    CHECK(hits < static_cast<int>(kCount));
    // Float's half unit in the last place at 16 is 1e-6; the tolerance is 1e-3 of a pixel: 0.012 at 11.
    CHECK(worst < 2e-5);
}

TEST_CASE("motion is the way on the screen to the next frame, of the turning ball and of the sky") {
    scene::Scene scene = ball();
    const glm::dvec3 to(1.6, 1.8, -8.5);
    scene.camera.keys = {{.time_s = 0.0, .position = scene.camera.position}, {.time_s = 1.0, .position = to}};
    scene.camera.interpolation = scene::Interpolation::linear;
    const Batch batch = random_batch(scene, kCount, scene.shutter.open_s);
    const Values values = evaluate(scene, batch);
    const double frame_s = 1.0 / 25.0;
    double longest = 0.0, worst = 0.0;
    for (std::size_t i = 0; i < kCount; ++i) {
        const Pinhole now(scene, glm::mix(scene.camera.position, to, batch.t[i]));
        const Pinhole next(scene, glm::mix(scene.camera.position, to, batch.t[i] + frame_s));
        glm::dvec3 seen = now.direction(batch.u[i], batch.v[i]);
        if (values.at(i, "depth").x != SampleView::kNothing) {
            const glm::dvec3 from_centre = values.at(i, "P") - scene.surface.origin;
            // The axis is the world's.
            const double angle = scene.surface.spin_deg_per_s * kDegree * frame_s;
            seen = scene.surface.origin + turned(from_centre, scene.surface.spin_axis, angle) - next.eye;
        }
        const glm::dvec2 way = next.screen(seen) - glm::dvec2(batch.u[i], batch.v[i]);
        const glm::dvec3 motion = values.at(i, "motion");
        worst = std::max({worst, std::abs(motion.x - way.x), std::abs(motion.y + way.y)});
        longest = std::max(longest, glm::length(way));
    }
    CHECK(longest > 0.5);
    CHECK(worst < 2e-4);
}

TEST_CASE("noise that drifts over a plane moves against its shift, and what rests has no motion at all") {
    scene::Scene scene;
    scene.film = {.width = 60, .height = 40};
    scene.surface.kind = solid::kKind<solid::HeightField>;
    scene.surface.octaves = 3;
    scene.camera.position = {0.0, 2.0, 0.0};
    scene.camera.look_at = {0.0, 0.0, 6.0};
    scene.camera.far = 50.0;
    const Batch batch = random_batch(scene, kCount, 0.0);
    for (std::size_t i = 0; i < kCount; ++i)
        CHECK(evaluate(scene, {{batch.u[i]}, {batch.v[i]}, {0.0}}).at(0, "motion") == glm::dvec3(0.0));

    scene.surface.drift = {3.0, 0.0, 1.0};
    const Values values = evaluate(scene, batch);
    const Pinhole camera(scene, scene.camera.position);
    double worst = 0.0;
    for (std::size_t i = 0; i < kCount; ++i) {
        if (values.at(i, "depth").x == SampleView::kNothing) continue;
        const glm::dvec3 next = values.at(i, "P") + scene.surface.drift / 25.0;
        const glm::dvec2 way = camera.screen(next - camera.eye) - glm::dvec2(batch.u[i], batch.v[i]);
        const glm::dvec3 motion = values.at(i, "motion");
        worst = std::max({worst, std::abs(motion.x - way.x), std::abs(motion.y + way.y)});
    }
    CHECK(worst < 2e-4);
}

TEST_CASE("a picture that traces nothing has channels as if nothing were hit") {
    scene::Scene scene;
    scene.image = scene::ImageKind::zoneplate;
    const Batch batch = random_batch(scene, 10, 0.0);
    const Values values = evaluate(scene, batch);
    for (std::size_t i = 0; i < 10; ++i) {
        CHECK(values.at(i, "Z").x == SampleView::kNothing);
        CHECK(values.at(i, "N") == glm::dvec3(0.0));
        CHECK(values.at(i, "motion") == glm::dvec3(0.0));
        CHECK(values.at(i, "steps").x == 0.0);
    }
}
