// What a Daylight promises whoever looks through the air; whether it is right is for test_daylight_levels, _colour and
// _oracle.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

#include "shaders_cpu/daylight/daylight.h"

using namespace strata::shaders;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 direction_of(double elevation_deg, double azimuth) {
    const double e = elevation_deg / 180.0 * kPi;
    return {std::cos(e) * std::cos(azimuth), std::sin(e), std::cos(e) * std::sin(azimuth)};
}

glm::dvec3 direction_at(double y, double azimuth) {
    const double level = std::sqrt(std::max(0.0, 1.0 - y * y));
    return {level * std::cos(azimuth), y, level * std::sin(azimuth)};
}

Daylight morning(double height = 1000.0) { return {Atmosphere{}, direction_of(12.0, 0.7), height}; }

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite_and_not_negative(const glm::dvec3& v) { return finite(v) && v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0; }

double relative(const glm::dvec3& a, const glm::dvec3& b) {
    return std::fabs(luminance(a) - luminance(b)) / std::max(luminance(b), 1e-300);
}

// All that it can say, as bits.
std::vector<double> everything(const Daylight& day) {
    std::vector<double> all;
    const auto add = [&](const glm::dvec3& v) { all.insert(all.end(), {v.x, v.y, v.z}); };
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 d = direction_at(2.0 * unit(random) - 1.0, 7.0 * unit(random));
        add(day.sky_radiance(d));
        add(day.aerial_from_observer(d, 1e5 * unit(random)).inscatter);
        add(day.aerial(4000.0 * unit(random), d, 1e5 * unit(random)).inscatter);
        add(day.sky_irradiance(d));
        add(day.ground_irradiance(d));
        add(day.sun_illuminance(1e4 * unit(random)));
        add(day.sample_sky(unit(random), unit(random)).direction);
    }
    return all;
}

}  // namespace

TEST_CASE("air of no length changes nothing, exactly") {
    const Daylight day = morning();
    for (const double y : {-1.0, -0.3, -0.0177, 0.0, 1e-9, 0.5, 1.0}) {
        for (const AerialPerspective& air :
             {day.aerial(1000.0, direction_at(y, 2.0), 0.0), day.aerial_from_observer(direction_at(y, 2.0), 0.0)}) {
            CHECK(air.transmittance == glm::dvec3(1.0));
            CHECK(air.inscatter == glm::dvec3(0.0));
        }
    }
}

TEST_CASE("air without end is the sky") {
    const Daylight day = morning();
    double worst = 0.0, worst_of_table = 0.0;
    for (const double y : {0.0, 0.01, 0.05, 0.2, 0.6, 1.0})
        for (double azimuth = 0.0; azimuth < 6.0; azimuth += 0.5) {
            const glm::dvec3 d = direction_at(y, azimuth);
            const AerialPerspective air = day.aerial(1000.0, d, kInfinity);
            worst = std::max(worst, relative(air.inscatter, day.sky_radiance(d)));
            worst_of_table = std::max(worst_of_table,
                                      relative(day.aerial_from_observer(d, kInfinity).inscatter, day.sky_radiance(d)));
            if (y == 0.0) CHECK(air.transmittance.b < 1e-3);
        }
    MESSAGE("integral within ", worst, ", table within ", worst_of_table);
    CHECK(worst < 0.02);
    CHECK(worst_of_table < 0.05);
}

TEST_CASE("air only takes away more and adds more with distance, and two stretches multiply") {
    const Daylight day = morning();
    for (const double y : {-0.1, 0.0, 0.1}) {
        const glm::dvec3 d = direction_at(y, 1.0);
        AerialPerspective before;
        for (double distance = 50.0; distance < 3e5; distance *= 1.3) {
            for (const bool table : {true, false}) {
                const AerialPerspective air =
                    table ? day.aerial_from_observer(d, distance) : day.aerial(1000.0, d, distance);
                for (int c = 0; c < 3; ++c) {
                    CHECK(air.transmittance[c] <= before.transmittance[c] + 0.01);
                    CHECK(air.inscatter[c] >= before.inscatter[c] * 0.99);
                }
                before = air;
            }
        }
    }
    // Level air, halved at a point that is hardly higher.
    const glm::dvec3 level(1.0, 0.0, 0.0);
    const glm::dvec3 whole = day.aerial(0.0, level, 20e3).transmittance;
    const glm::dvec3 half = day.aerial(0.0, level, 10e3).transmittance;
    for (int c = 0; c < 3; ++c) CHECK(whole[c] == doctest::Approx(half[c] * half[c]).epsilon(0.005));
}

TEST_CASE("the observer's table agrees with the integral") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit;
    double worst_transmittance = 0.0, worst_inscatter = 0.0;
    for (const double elevation : {60.0, 10.0, -2.0})
        for (const double height : {2.0, 2500.0}) {
            const Daylight day(Atmosphere{}, direction_of(elevation, 0.0), height);
            double brightest = 0.0;
            for (double azimuth = 0.0; azimuth < 6.0; azimuth += 0.3)
                brightest = std::max(brightest, luminance(day.sky_radiance(direction_at(0.02, azimuth))));
            for (int i = 0; i < 1000; ++i) {
                const glm::dvec3 d = direction_at(std::pow(2.0 * unit(random) - 1.0, 3.0) * 0.5, 7.0 * unit(random));
                const double distance = std::pow(10.0, 1.0 + 4.2 * unit(random));
                const AerialPerspective truth = day.aerial(height, d, distance);
                const AerialPerspective table = day.aerial_from_observer(d, distance);
                for (int c = 0; c < 3; ++c)
                    worst_transmittance =
                        std::max(worst_transmittance, std::fabs(truth.transmittance[c] - table.transmittance[c]));
                worst_inscatter = std::max(
                    worst_inscatter, std::fabs(luminance(truth.inscatter) - luminance(table.inscatter)) / brightest);
            }
        }
    MESSAGE("transmittance within ", worst_transmittance, ", in-scatter within ", worst_inscatter, " of the brightest");
    CHECK(worst_transmittance < 0.02);
    CHECK(worst_inscatter < 0.02);
}

TEST_CASE("from high up the air is the integral itself") {
    const Daylight day(Atmosphere{}, direction_of(40.0, 0.0), 50e3);
    const glm::dvec3 down = direction_at(-0.5, 1.0);
    CHECK(day.aerial_from_observer(down, 90e3).inscatter == day.aerial(50e3, down, 90e3).inscatter);
}

TEST_CASE("what is seen below the horizon is the lit sphere through the air") {
    const Daylight day = morning();
    for (const double y : {-0.05, -0.2, -0.7, -1.0}) {
        const glm::dvec3 d = direction_at(y, 0.7);
        const AerialPerspective air = day.aerial(1000.0, d, distance_to_ground(1000.0, y));
        const double sun = luminance(day.sun_illuminance(0.0)) * day.sun_direction().y;
        const double ground = 0.2 / kPi * (sun + luminance(day.sky_irradiance({0, 1, 0})));
        const double seen = luminance(day.sky_radiance(d));
        CHECK(seen == doctest::Approx(luminance(air.transmittance * ground + air.inscatter)).epsilon(0.05));
    }
}

TEST_CASE("light is finite and not negative at the ends of all ranges") {
    for (const double elevation : {-90.0, -6.0, -0.2666, 0.0, 90.0})
        for (const double height : {-1000.0, 0.0, 10e3, 100e3})
            for (const double visibility : {1e3, 1e9}) {
                Atmosphere atmosphere;
                atmosphere.visibility = visibility;
                const Daylight day(atmosphere, direction_of(elevation, 1.1), height);
                CAPTURE(elevation);
                CAPTURE(height);
                CAPTURE(visibility);
                bool good = finite_and_not_negative(day.sun_illuminance(height));
                const double horizon = horizon_up(day.observer_height());
                for (const double y :
                     {-1.0, -0.5, horizon - 1e-9, horizon, horizon + 1e-9, 0.0, 1e-12, 0.3, 1.0 - 1e-12, 1.0})
                    for (const double azimuth : {0.0, 1.1, 1.1 + kPi, 4.0}) {
                        const glm::dvec3 d = direction_at(y, azimuth);
                        good = good && finite_and_not_negative(day.sky_radiance(d)) &&
                               finite_and_not_negative(day.sky_irradiance(d)) &&
                               finite_and_not_negative(day.ground_irradiance(d)) && std::isfinite(day.sky_pdf(d));
                        for (const double distance : {0.0, 1e-30, 1.0, 1e4, 1e6, 1e30, kInfinity})
                            for (const AerialPerspective& air :
                                 {day.aerial(height, d, distance), day.aerial_from_observer(d, distance)})
                                good = good && finite_and_not_negative(air.inscatter) &&
                                       finite_and_not_negative(air.transmittance) && air.transmittance.r <= 1.0;
                    }
                for (const double u : {0.0, 0.5, 1.0 - 0x1p-53}) {
                    const SkySample sample = day.sample_sky(u, u);
                    good = good && finite(sample.direction) && sample.pdf > 0.0 && sample.direction.y >= 0.0;
                }
                CHECK(good);
            }
}

TEST_CASE("the sky is symmetric about the sun's azimuth and turns with it") {
    const Daylight day(Atmosphere{}, direction_of(8.0, 0.0), 500.0);
    const Daylight turned(Atmosphere{}, direction_of(8.0, 2.5), 500.0);
    double worst_mirror = 0.0, worst_turn = 0.0;
    for (const double y : {-0.4, -0.02, 0.01, 0.2, 0.7, 0.99})
        for (double azimuth = 0.05; azimuth < 3.1; azimuth += 0.1) {
            const glm::dvec3 seen = day.sky_radiance(direction_at(y, azimuth));
            worst_mirror = std::max(worst_mirror, relative(day.sky_radiance(direction_at(y, -azimuth)), seen));
            worst_turn = std::max(worst_turn, relative(turned.sky_radiance(direction_at(y, azimuth + 2.5)), seen));
            CHECK(day.aerial_from_observer(direction_at(y, azimuth), 3e4).inscatter.g ==
                  doctest::Approx(day.aerial_from_observer(direction_at(y, -azimuth), 3e4).inscatter.g));
            const glm::dvec3 n = direction_at(y, azimuth);
            CHECK(luminance(day.sky_irradiance(n)) ==
                  doctest::Approx(luminance(day.sky_irradiance({n.x, n.y, -n.z}))).epsilon(1e-6));
        }
    CHECK(worst_mirror < 1e-9);
    CHECK(worst_turn < 1e-5);  // tables are in float
}

TEST_CASE("equal arguments give equal bits, on any thread") {
    const std::vector<double> first = everything(morning());
    std::array<std::vector<double>, 3> others;
    std::vector<std::thread> threads;
    for (auto& other : others) threads.emplace_back([&other] { other = everything(morning()); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& other : others) {
        REQUIRE(other.size() == first.size());
        CHECK(std::memcmp(other.data(), first.data(), first.size() * sizeof(double)) == 0);
    }
    CHECK(everything(morning(1001.0)) != first);
}

TEST_CASE("a batch is its parts, to the bit") {
    const Daylight day = morning();
    for (const std::size_t count : {0, 1, 7, 8, 9, 33}) {
        std::vector<float> x, y, z, distance;
        for (std::size_t i = 0; i < count; ++i) {
            const auto turn = static_cast<double>(i);
            const glm::vec3 d(direction_at(std::sin(turn * 1.7), turn * 0.9));
            x.push_back(d.x), y.push_back(d.y), z.push_back(d.z), distance.push_back(static_cast<float>(i * i) * 90.0f);
        }
        std::array<std::vector<float>, 9> out;
        for (auto& channel : out) channel.resize(count);
        day.sky_radiance({x, y, z}, {out[0], out[1], out[2]});
        day.aerial_from_observer({x, y, z}, distance, {out[3], out[4], out[5]}, {out[6], out[7], out[8]});
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 d(x[i], y[i], z[i]);
            CHECK(glm::vec3(day.sky_radiance(d)) == glm::vec3(out[0][i], out[1][i], out[2][i]));
            const AerialPerspective air = day.aerial_from_observer(d, distance[i]);
            CHECK(glm::vec3(air.transmittance) == glm::vec3(out[3][i], out[4][i], out[5][i]));
            CHECK(glm::vec3(air.inscatter) == glm::vec3(out[6][i], out[7][i], out[8][i]));
        }
    }
}
