// Gradients in SIMD against the reference path, on every target.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "noise/float_error.h"
#include "tests/trace/fast_tracer_cases.h"

using namespace strata;
using namespace strata::trace_test;

namespace {

std::vector<glm::dvec3> points(Random& random, std::size_t count, double reach) {
    std::vector<glm::dvec3> x(count);
    for (glm::dvec3& p : x) p = log_uniform(random, 1e-3, reach) * unit_vector(random);
    return x;
}

// Bound of a float gradient's error, of sum a_k w_k: rounding of the evaluation, of the sum of up to 32 octaves, and of
// the base.
double bound(const trace::Field& field) {
    double slopes = 0.0;
    for (const noise::Octave& octave : field.octaves()) slopes += octave.amplitude * octave.frequency;
    const noise::FloatErrors& errors = field.is_planar_noise() ? noise::kFloatErrors2 : noise::kFloatErrors3;
    return errors.slope * slopes + 40 * 0x1p-24 * field.lipschitz();
}

}  // namespace

TEST_CASE("gradients of drifting noise agree with the reference path, each point at its own time, on every target") {
    on_every_target([](const std::string& target) {
        Random random(43);
        double worst = 0.0;
        for (int trial = 0; trial < 40; ++trial) {
            scene::Surface surface = random_drifting_surface(random);
            surface.kind = support::any_kind(static_cast<std::uint64_t>(trial));
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            const std::vector<glm::dvec3> x = points(random, 1 + random() % 70, 20.0);
            std::vector<glm::dvec3> shift(x.size());
            for (glm::dvec3& s : shift) s = field.noise_shift(uniform(random, -50.0, 50.0));
            std::vector<glm::vec3> found(x.size());
            trace::TraceCounters counters;
            tracer.gradients(x, shift, found, counters);
            for (std::size_t i = 0; i < x.size(); ++i) {
                const double error = glm::length(glm::dvec3(found[i]) - field.gradient(x[i], shift[i]));
                worst = std::max(worst, error / bound(field));
            }
        }
        MESSAGE(target << ": largest error " << worst << " of the bound");
        CHECK(worst < 1.0);
    });
}

TEST_CASE("gradients agree with the reference path within float rounding, near and far, on every target") {
    on_every_target([](const std::string& target) {
        Random random(41);
        double worst = 0.0;
        for (int trial = 0; trial < 80; ++trial) {
            scene::Surface surface = random_surface(random);
            surface.kind = support::any_kind(static_cast<std::uint64_t>(trial));
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            // Every third reaches beyond the cells that share a block of the hash.
            const double reach = trial % 3 == 0 ? 0x1p33 / field.octaves().back().frequency : 100.0;
            const std::vector<glm::dvec3> x = points(random, 1 + random() % 70, reach);
            std::vector<glm::vec3> found(x.size());
            trace::TraceCounters counters;
            tracer.gradients(x, found, counters);
            for (std::size_t i = 0; i < x.size(); ++i) {
                const double error = glm::length(glm::dvec3(found[i]) - field.gradient(x[i]));
                // Positions this far are rounded in double before they get to the lattice.
                double place = 0.0;
                for (const noise::Octave& o : field.octaves()) {
                    place += o.amplitude * o.frequency * 15.0 * 0x1p-51 * o.frequency * glm::length(x[i]);
                }
                worst = std::max(worst, error / (bound(field) + place));
            }
            CHECK(counters.noise_evaluations == x.size() * field.octaves().size());
            CHECK(counters.executed_lanes >= counters.noise_evaluations);
        }
        MESSAGE(target << ": largest error " << worst << " of the bound");
        CHECK(worst < 1.0);
        CHECK(worst > 0.0);
    });
}

TEST_CASE("a point's gradient has the same bits in any batch, beside near and far points, on every target") {
    on_every_target([](const std::string&) {
        Random random(42);
        for (int trial = 0; trial < 16; ++trial) {
            scene::Surface surface = random_surface(random);
            surface.kind = support::any_kind(static_cast<std::uint64_t>(trial));
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            std::vector<glm::dvec3> x = points(random, 100, 50.0);
            for (std::size_t i = 0; i < x.size(); i += 7) x[i] *= 0x1p32 / field.octaves().back().frequency;
            std::vector<glm::vec3> alone(x.size());
            trace::TraceCounters counters;
            for (std::size_t i = 0; i < x.size(); ++i) tracer.gradients({&x[i], 1}, {&alone[i], 1}, counters);
            int different = 0;
            for (std::size_t begin = 0, size = 1; begin < x.size(); begin += size, size = 1 + random() % 40) {
                const std::size_t count = std::min(size, x.size() - begin);
                std::vector<glm::vec3> found(count);
                tracer.gradients(std::span(x).subspan(begin, count), found, counters);
                different += std::memcmp(found.data(), &alone[begin], count * sizeof(glm::vec3)) != 0;
            }
            CHECK(different == 0);
        }
    });
}

TEST_CASE("without octaves the gradient is the base's") {
    Random random(43);
    for (const solid::Kind kind : support::all_kinds()) {
        scene::Surface surface = surface_of(kind);
        surface.amplitude = 0.0;
        const trace::Field field(surface);
        const trace::FastTracer tracer(field);
        const std::vector<glm::dvec3> x = points(random, 33, 10.0);
        std::vector<glm::vec3> found(x.size());
        trace::TraceCounters counters;
        tracer.gradients(x, found, counters);
        for (std::size_t i = 0; i < x.size(); ++i) CHECK(found[i] == glm::vec3(field.base_gradient(x[i])));
        CHECK(counters.noise_evaluations == 0);
    }
}
