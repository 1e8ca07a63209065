// Windows: their polynomials against the octaves that they stand for, all over the ball that they are for.
#include "src/trace/window.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/trace/window_jets.h"
#include "src/trace/window_plan.h"
#include "tests/trace/fast_tracer_cases.h"
#include "tests/trace/ray_families.h"

using namespace strata;
using namespace strata::trace_test;
using trace::Window;

namespace {

struct SizedWindow {
    Window window;
    double radius = 0.0;
};

scene::Surface window_surface(Random& random, int index) {
    scene::Surface surface = random_surface(random);
    surface.kind = support::any_kind(static_cast<std::uint64_t>(index));
    if (index % 5 == 1) {
        surface.octaves = 17 + static_cast<int>(random() % 8);
        surface.gain = std::min(surface.gain, 0.55);
    }
    return surface;
}

// Anywhere, at lattice points of an octave, where rounding is coarse.
glm::dvec3 centre(Random& random, const trace::Field& field) {
    const glm::dvec3 near = uniform(random, 0.0, 50.0) * unit_vector(random);
    const noise::Octave& octave = field.octaves()[random() % field.octaves().size()];
    const glm::dvec3 offset(octave.offset[0], octave.offset[1], octave.offset[2]);
    switch (random() % 4) {
        case 0:
            return (glm::round(near * octave.frequency) - offset) / octave.frequency;
        case 1:
            return near + std::exp2(uniform(random, 10.0, 31.0)) * unit_vector(random);
        default:
            return near;
    }
}

std::vector<SizedWindow> make_windows(Random& random, const trace::Field& field, std::size_t count) {
    const trace::WindowPlan plan(field);
    std::vector<Window> windows;
    std::vector<double> radii;
    for (std::size_t tries = 0; windows.size() < count && tries < 10 * count; ++tries) {
        const trace::WindowPlan::Size size = plan.size(log_uniform(random, 1e-6, 0.5) * field.amplitude());
        if (size.octaves == 0) continue;
        Window& window = windows.emplace_back();
        window.centre = centre(random, field);
        window.octaves = size.octaves;
        const glm::dvec3 reach = glm::abs(window.centre);
        window.error = plan.error(size, std::max({reach.x, reach.y, reach.z}));
        radii.push_back(size.radius);
    }
    trace::TraceCounters counters;
    trace::WindowJets(field).evaluate(windows, counters);
    std::vector<SizedWindow> sized(windows.size());
    for (std::size_t i = 0; i < sized.size(); ++i) sized[i] = {windows[i], radii[i]};
    return sized;
}

float polynomial(const Window& window, const glm::vec3& off) {
    const auto& h = window.hessian;
    const glm::vec3 turn(h[0] * off.x + h[3] * off.y + h[4] * off.z, h[3] * off.x + h[1] * off.y + h[5] * off.z,
                         h[4] * off.x + h[5] * off.y + h[2] * off.z);
    return window.value + glm::dot(window.gradient + 0.5f * turn, off);
}

// Of the polynomial at that displacement, over what it may be.
double error_share(const trace::Field& field, const Window& window, const glm::dvec3& off) {
    const glm::dvec3 x = window.centre + off;
    double noise = 0.0;
    for (std::size_t k = 0; k < field.octaves().size(); ++k) noise += field.octave(k, x);
    const double found = static_cast<double>(polynomial(window, glm::vec3(x - window.centre)));
    return std::abs(found - noise) / static_cast<double>(window.error);
}

// Climbs from points of the ball.
double greatest_share(Random& random, const trace::Field& field, const SizedWindow& sized) {
    double best = 0.0;
    glm::dvec3 at(0.0);
    for (int i = 0; i < 24; ++i) {
        const double share = random() % 2 == 0 ? 1.0 : uniform(random, 0.0, 1.0);
        const glm::dvec3 off = share * sized.radius * unit_vector(random);
        const double error = error_share(field, sized.window, off);
        if (error > best) best = error, at = off;
    }
    for (double step = 0.5; step > 0.01; step *= 0.8) {
        glm::dvec3 off = at + step * sized.radius * unit_vector(random);
        off *= std::min(1.0, sized.radius / glm::length(off));
        const double error = error_share(field, sized.window, off);
        if (error > best) best = error, at = off;
    }
    return best;
}

}  // namespace

TEST_CASE("a window's polynomial is off by less than its error anywhere in its ball, on every target") {
    on_every_target([](const std::string& target) {
        Random random(20061118);
        double greatest = 0.0;
        std::size_t count = 0, partial = 0;
        for (int i = 0; i < 60; ++i) {
            const scene::Surface surface = window_surface(random, i);
            const trace::Field field(surface);
            CAPTURE(surface.seed);
            CAPTURE(surface.octaves);
            for (const SizedWindow& sized : make_windows(random, field, 40)) {
                const double share = greatest_share(random, field, sized);
                CHECK(share < 1.0);
                greatest = std::max(greatest, share);
                partial += sized.window.octaves < field.octaves().size();
                ++count;
            }
        }
        MESSAGE(target << ": " << count << " windows, " << partial
                       << " of them without the finest octaves; greatest error " << greatest << " of its bound");
        CHECK(count > 1500);
        CHECK(partial * 20 > count);
        CHECK(greatest > 0.1);
    });
}

TEST_CASE("a larger error allows a larger window, and one without octaves none") {
    scene::Surface surface = surface_of(solid::kKind<solid::DisplacedPlane>);
    surface.octaves = 12;
    const trace::Field field(surface);
    const trace::WindowPlan plan(field);
    double last = 0.0;
    for (double error = 1e-6; error < 1.0; error *= 1.7) {
        const trace::WindowPlan::Size size = plan.size(error);
        if (size.octaves == 0) {
            CHECK(last == 0.0);
            continue;
        }
        CHECK(size.radius > last);
        CHECK(plan.error(size, 10.0) < 1.2 * error);
        last = size.radius;
    }
    CHECK(last > 0.0);
    surface.amplitude = 0.0;
    CHECK(trace::WindowPlan(trace::Field(surface)).size(1.0).octaves == 0);
}
