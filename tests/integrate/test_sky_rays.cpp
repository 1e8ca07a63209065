// Light of the sky by rays and light that ground reflects: energy, and what is known by formula or brute force.
#include <doctest/doctest.h>

#include <random>

#include "shaders_cpu/sky.h"
#include "src/integrate/directions.h"
#include "tests/integrate/light_samples.h"

using namespace strata;
using namespace strata::light_samples;

// Each path that leaves the ground brings the sky's radiance, whole: its weights are 1.
TEST_CASE("white furnace: white ground under an even sky has the sky's radiance, path by path") {
    scene::Scene scene = scene_from_above(2.0);
    make_furnace(scene, 0.7);
    scene.sky.bounces = 16;
    const Samples samples(64, 64);
    int lost = 0;
    const std::vector<glm::vec3> radiance = evaluate(scene, samples);
    for (const glm::vec3& c : radiance) {
        if (c.g < 0.5f) {
            ++lost;  // still under way after 16 reflections
            CHECK(c == glm::vec3(0.0f));
        } else {
            CHECK(c.g == doctest::Approx(0.7).epsilon(1e-5));
        }
    }
    CHECK(lost < 8);
    MESSAGE("paths longer than 16 reflections: ", lost, " of ", radiance.size());
}

TEST_CASE("each reflection more adds light to some samples and takes none, and the sky's own share is what escapes") {
    scene::Scene scene = scene_from_above(2.0);
    make_furnace(scene, 1.0);
    const Samples samples(32, 16);
    std::vector<glm::vec3> before(samples.u.size(), glm::vec3(0.0f));
    double previous = 0.0;
    for (const int bounces : {0, 1, 2, 4, 8}) {
        scene.sky.bounces = bounces;
        Counters counters;
        const std::vector<glm::vec3> radiance = evaluate(scene, samples, &counters);
        double sum = 0.0;
        for (std::size_t i = 0; i < radiance.size(); ++i) {
            REQUIRE(radiance[i].g >= before[i].g);
            sum += static_cast<double>(radiance[i].g);
        }
        CHECK(sum > previous);
        previous = sum;
        CHECK(counters.hits == samples.u.size());
        CHECK(counters.sky_rays >= counters.hits);
        CHECK(counters.sky_rays <= counters.hits * static_cast<std::uint64_t>(1 + bounces));
        CHECK(counters.unresolved_rays == 0);
        before = radiance;
    }
    CHECK(previous < static_cast<double>(samples.u.size()) * 1.00001);
}

TEST_CASE("level ground under the gradient sky has the light that its formula says, within 3 sigma") {
    const scene::Scene scene = scene_from_above(0.0);
    const Samples samples = at_one_place(200, 16, 8.3, 7.1);
    const std::vector<glm::vec3> radiance = evaluate(scene, samples);
    for (const int channel : {0, 2}) {
        const Mean mean = mean_of(radiance, 16, channel);
        const double expected = 0.5 * static_cast<double>(shaders::ambient_light(scene.sky, 1.0)[channel]);
        CHECK(std::abs(mean.value - expected) < 3.0 * mean.error + 1e-6);
        CHECK(mean.error < 0.01 * expected);
    }
}

// A ball, at whose side half of what is seen lies under the horizon. By quadrature.
TEST_CASE("half world: a ball under the gradient sky has the cosine-weighted mean of what it sees, within 3 sigma") {
    for (const double turn_deg : {0.0, 35.0, 90.0, 150.0}) {
        CAPTURE(turn_deg);
        scene::Scene scene = scene_from_above(0.0);
        scene.surface.kind = solid::kKind<solid::Sphere>;
        scene.surface.shape<solid::Sphere>().radius = 2.0;
        scene.sky.zenith = {0.1, 3.0, 0.5};
        scene.sky.horizon = {1.0, 0.2, 0.3};
        const double turn = glm::radians(turn_deg);
        const glm::dvec3 normal{-std::sin(turn), std::cos(turn), 0.0};
        scene.camera.position = normal * 7.0;
        scene.camera.look_at = {0.0, 0.0, 0.0};
        glm::dvec3 sum(0.0);
        constexpr int kRows = 400, kColumns = 200;
        for (int i = 0; i < kRows; ++i) {
            for (int j = 0; j < kColumns; ++j) {
                const glm::dvec3 d = cosine_direction(normal, (i + 0.5) / kRows, (j + 0.5) / kColumns);
                sum += glm::dvec3(shaders::sky_radiance(scene.sky, d));
            }
        }
        const std::vector<glm::vec3> radiance = evaluate(scene, at_one_place(100, 16, 8.0, 8.0));
        for (const int channel : {0, 1, 2}) {
            const Mean mean = mean_of(radiance, 16, channel);
            const double expected = 0.5 * sum[channel] / (kRows * kColumns);
            CHECK(std::abs(mean.value - expected) < 3.0 * mean.error + 1e-4 * expected);
        }
    }
}

// By another way: even directions over the hemisphere from a generator of its own, rays marched in steps of 0.02
// through the field in double, every point of the ground lit by the sun alone.
TEST_CASE("sky and one reflection of sunlight in a valley are what brute force finds, within 4 sigma") {
    scene::Scene scene = scene_from_above(3.0);
    scene.surface.octaves = 2;
    scene.sun.intensity = 3.0;
    scene.sun.direction = {1.0, 0.7, 0.2};
    scene.sun.colour = {1.0, 1.0, 1.0};
    scene.sky.zenith = scene.sky.horizon = {0.0, 0.3, 0.0};
    scene.camera.position = {0.3, 12.0, 0.2};
    const SurfaceImage image(scene, Tracer::reference);
    const trace::Field& field = image.field();
    const glm::dvec3 sun = glm::normalize(scene.sun.direction);
    const auto march = [&](glm::dvec3 x, const glm::dvec3& d) {
        const double highest = field.amplitude();
        for (; x.y < highest; x += 0.02 * d)
            if (field.value(x) < 0.0) return std::pair(true, x);
        return std::pair(false, x);
    };
    const auto lift = [&](const glm::dvec3& x, const glm::dvec3& n) { return x + 0.02 * n; };
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> unit;
    for (const double place : {4.0, 7.5, 11.0}) {
        trace::Ray ray = image.local_camera_ray(place, 16.0 - place, 0.0);
        trace::Hit hit;
        trace::TraceCounters traced;
        image.trace(std::span(&ray, 1), std::span(&hit, 1), traced);
        REQUIRE(hit.state == trace::HitState::hit);
        const glm::dvec3 x = ray.origin + hit.s * ray.direction;
        const glm::dvec3 n = glm::normalize(field.gradient(x, glm::dvec3(0.0)));
        const auto sunlight = [&](const glm::dvec3& at, const glm::dvec3& normal) {
            const double cosine = glm::dot(normal, sun);
            if (cosine <= 0.0 || march(lift(at, normal), sun).first) return 0.0;
            return 3.0 / kPi * cosine;
        };
        double sum_sky = 0.0, sum2_sky = 0.0, sum_sun = 0.0, sum2_sun = 0.0;
        constexpr int kCount = 4000;
        for (int i = 0; i < kCount; ++i) {
            const double cosine = unit(random), angle = 2.0 * kPi * unit(random);
            const double sine = std::sqrt(1.0 - cosine * cosine);
            const glm::dvec3 a = glm::normalize(glm::cross(n, glm::dvec3(0.3, 0.1, 1.0))), b = glm::cross(n, a);
            const glm::dvec3 d = cosine * n + sine * (std::cos(angle) * a + std::sin(angle) * b);
            const auto [hits, at] = march(lift(x, n), d);
            double from_sky = 0.0, from_sun = 0.0;  // even density 1 / (2 pi): the weight is 2 cosine
            if (hits) {
                from_sun = 2.0 * cosine * 0.5 * sunlight(at, glm::normalize(field.gradient(at, glm::dvec3(0.0))));
            } else {
                from_sky = 2.0 * cosine * 0.3;
            }
            sum_sky += from_sky;
            sum2_sky += from_sky * from_sky;
            sum_sun += from_sun;
            sum2_sun += from_sun * from_sun;
        }
        const auto result = [&](double sum, double sum2) {
            const double mean = sum / kCount;
            return Mean{mean, std::sqrt((sum2 / kCount - mean * mean) / kCount)};
        };
        const Mean sky = result(sum_sky, sum2_sky), bounce = result(sum_sun, sum2_sun);

        const Samples samples = at_one_place(64, 64, place, 16.0 - place);
        const auto of = [&](int bounces) {
            scene::Scene with = scene;
            with.sky.bounces = bounces;
            return evaluate(with, samples);
        };
        const std::vector<glm::vec3> none = of(0), one = of(1);
        // Red is light of the sun: direct and reflected. Green less red is that of the sky, direct for no reflection.
        std::vector<glm::vec3> apart(none.size());
        for (std::size_t i = 0; i < none.size(); ++i)
            apart[i] = {none[i].g - none[i].r, one[i].r - none[i].r, none[i].r};
        const Mean found_sky = mean_of(apart, 64, 0), found_bounce = mean_of(apart, 64, 1);
        const double direct = mean_of(apart, 64, 2).value;
        CAPTURE(place);
        CHECK(direct == doctest::Approx(0.5 * sunlight(x, n)).epsilon(1e-4));
        CHECK(std::abs(found_sky.value - 0.5 * sky.value) < 4.0 * std::hypot(found_sky.error, 0.5 * sky.error));
        CHECK(std::abs(found_bounce.value - 0.5 * bounce.value) <
              4.0 * std::hypot(found_bounce.error, 0.5 * bounce.error));
        MESSAGE("sky ", found_sky.value, " by brute force ", 0.5 * sky.value, "; reflected sunlight ",
                found_bounce.value, " by brute force ", 0.5 * bounce.value, ", one sigma ", 0.5 * bounce.error);
    }
}

TEST_CASE("level ground in daylight has the irradiance of its sky by quadrature, within 3 sigma") {
    scene::Scene scene = scene_from_above(0.0);
    scene.sky.model = scene::SkyModel::daylight;
    scene.sky.gain = 1.5;
    scene.sun.direction = {1.0, 0.3, 0.2};
    scene.sun.shadow_height = 1e5;  // none of the sun itself
    const glm::dvec3 sun = glm::normalize(scene.sun.direction);
    const shaders::DaylightScene air(scene, sun, scene.camera.position);
    double expected = 0.0;
    constexpr int kRows = 300, kColumns = 300;
    for (int i = 0; i < kRows; ++i) {
        for (int j = 0; j < kColumns; ++j) {
            const glm::dvec3 d = cosine_direction({0.0, 1.0, 0.0}, (i + 0.5) / kRows, (j + 0.5) / kColumns);
            expected += 0.5 * 1.5 * static_cast<double>(air.sky(d).g) / (kRows * kColumns);
        }
    }
    scene::Scene bare = scene;
    bare.camera.position.y = 1.0;  // no air to speak of in between
    bare.scale.metres = 1e-3;
    const Mean mean = mean_of(evaluate(bare, at_one_place(200, 16, 8.0, 8.0)), 16);
    CHECK(std::abs(mean.value - expected) < 3.0 * mean.error + 2e-3 * expected);
    MESSAGE("mean ", mean.value, ", by quadrature ", expected, ", one sigma ", mean.error);
}

TEST_CASE("a ball that spins is lit by the sky as one at rest") {
    scene::Scene scene = scene_from_above(0.0);
    scene.surface.kind = solid::kKind<solid::Sphere>;
    scene.surface.shape<solid::Sphere>().radius = 2.0;
    scene.camera.position = {0.5, 1.0, -6.0};
    scene.camera.look_at = {0.0, 0.3, 0.0};
    scene.camera.up = {0.0, 1.0, 0.0};
    scene.camera.fov_deg = 15.0;
    const auto mean_at = [&](double time, double spin) {
        scene.surface.spin_deg_per_s = spin;
        scene.surface.spin_axis = {1.0, 0.4, 0.2};
        Samples samples = at_one_place(100, 16, 8.0, 8.0);
        std::ranges::fill(samples.t, time);
        return mean_of(evaluate(scene, samples), 16, 0);
    };
    const Mean rest = mean_at(0.0, 0.0), turned = mean_at(1.0, 100.0);
    CHECK(std::abs(rest.value - turned.value) < 3.0 * std::hypot(rest.error, turned.error));
    CHECK(rest.error < 0.01 * rest.value);
}

TEST_CASE("both tracers find the same light, but for a few rays that graze") {
    scene::Scene scene = scene_from_above(2.0);
    scene.sun.intensity = 2.0;
    scene.sun.angular_radius_deg = 3.0;
    scene.sky.bounces = 2;
    const Samples samples(64, 9);
    const std::vector<glm::vec3> fast = evaluate(scene, samples),
                                 reference = evaluate(scene, samples, nullptr, Tracer::reference);
    int different = 0;
    for (std::size_t i = 0; i < fast.size(); ++i) different += std::abs(fast[i].g - reference[i].g) > 2e-3f;
    CHECK(different < 12);
    MESSAGE("different: ", different, " of ", fast.size());
}
