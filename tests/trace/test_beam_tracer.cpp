// Beams: what is before a beam's end is free, by an oracle; how much farther it could have gone; same bits in any
// company.
#include "src/trace/beam_tracer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "tests/trace/beam_families.h"
#include "tests/trace/fast_tracer_cases.h"

using namespace strata;
using namespace strata::trace_test;
using trace::Beam;
using trace::BeamEnd;

namespace {

std::vector<BeamEnd> ends_of(const trace::BeamTracer& tracer, std::span<const Beam> beams,
                             trace::TraceCounters& counters) {
    std::vector<BeamEnd> ends(beams.size());
    tracer.trace(beams, ends, counters);
    return ends;
}

std::vector<BeamEnd> ends_of(const trace::BeamTracer& tracer, std::span<const Beam> beams) {
    trace::TraceCounters counters;
    return ends_of(tracer, beams, counters);
}

bool same(const BeamEnd& a, const BeamEnd& b) {
    return a.s == b.s && a.hint == b.hint && a.slope == b.slope && a.misses == b.misses;
}

// Displacements of the noise that the beam allows: none, a random one, and the one that raises the noise most where
// the beam ends.
std::vector<glm::dvec3> noise_offsets(Random& random, const trace::Field& field, const Beam& beam, double end) {
    if (beam.noise_radius == 0.0) return {glm::dvec3(0.0)};
    const double radius = beam.noise_radius * (1.0 - 1e-7);
    const glm::dvec3 x = beam.origin + end * beam.direction;
    const glm::dvec3 uphill = field.base_gradient(x) - field.gradient(x, beam.noise_shift);
    std::vector<glm::dvec3> offsets = {glm::dvec3(0.0), radius * unit_vector(random)};
    if (glm::length(uphill) > 0.0) offsets.push_back(radius * glm::normalize(uphill));
    return offsets;
}

struct Tally {
    int beams = 0, moved = 0, missed = 0, from_inside = 0, violations = 0;
    double lowest = std::numeric_limits<double>::infinity();  // f before an end, over lipschitz * radius
    std::vector<double> gaps;                                 // how much farther a beam could have gone, in radii
};

void check_beam(Random& random, const trace::Field& field, const Beam& beam, const BeamEnd& end, Tally& tally) {
    ++tally.beams;
    REQUIRE(std::isfinite(end.hint));
    REQUIRE(end.s >= beam.start);
    REQUIRE(end.misses == (end.s >= beam.limit));
    tally.missed += end.misses;
    if (!(end.s > beam.start)) return;
    ++tally.moved;
    // A miss may claim much beyond the limit: most points go where the limit is.
    const double upper = end.misses ? std::min(end.s, beam.limit * 1.5) : end.s;
    for (const glm::dvec3& offset : noise_offsets(random, field, beam, upper)) {
        const BundleProbe probe(field.surface(), beam, offset);
        const auto place = probe.lowest(random, beam.start, upper, 24, 16);
        if (!std::isfinite(place.f)) continue;  // the beam is narrower than what double can tell
        if (!probe.is_free(place)) {
            ++tally.violations;
            INFO("origin " << beam.origin.x << ' ' << beam.origin.y << ' ' << beam.origin.z << " direction "
                           << beam.direction.x << ' ' << beam.direction.y << ' ' << beam.direction.z << " radius0 "
                           << beam.radius0 << " spread " << beam.spread << " noise_radius " << beam.noise_radius
                           << " start " << beam.start << " end " << end.s << " limit " << beam.limit << " at s "
                           << place.s << " f " << place.f);
            CHECK(false);
        }
        const double radius = probe.radius(place.s) + beam.noise_radius;
        if (radius > 0.0) tally.lowest = std::min(tally.lowest, place.f / (field.lipschitz() * radius));
    }
}

// In half radii of the bundle at its end, up to 32 of them.
void measure_gap(Random& random, const trace::Field& field, const Beam& beam, const BeamEnd& end, Tally& tally) {
    const BundleProbe probe(field.surface(), beam, glm::dvec3(0.0));
    const double radius = probe.radius(end.s) + beam.noise_radius;
    if (end.misses || !(end.s > beam.start) || !(radius > 1e-12 * glm::length(beam.origin))) return;
    int halves = 0;
    while (halves < 32 && probe.is_free(probe.lowest(random, end.s + 0.5 * halves * radius,
                                                     end.s + 0.5 * (halves + 1) * radius, 6, 8))) {
        ++halves;
    }
    tally.gaps.push_back(0.5 * halves);
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::vector<Beam> hard_beams(Random& random, const trace::Field& field, std::size_t count) {
    const BeamFamilies families(field);
    std::vector<Beam> beams(count);
    for (Beam& beam : beams) beam = families.make(random);
    return beams;
}

}  // namespace

TEST_CASE("the whole bundle is free of the surface up to a beam's end, on every target") {
    on_every_target([](const std::string& target) {
        Random random(71);
        Tally tally;
        for (int i = 0; i < 132; ++i) {
            const scene::Surface surface = beam_surface(random, i);
            CAPTURE(static_cast<int>(surface.kind));
            CAPTURE(surface.octaves);
            CAPTURE(surface.seed);
            const trace::Field field(surface);
            const trace::BeamTracer tracer(field);
            const std::vector<Beam> beams = hard_beams(random, field, 60);
            const std::vector<BeamEnd> ends = ends_of(tracer, beams);
            for (std::size_t k = 0; k < beams.size(); ++k) {
                check_beam(random, field, beams[k], ends[k], tally);
                if (target == kTargets.front() && k % 4 == 0) {
                    measure_gap(random, field, beams[k], ends[k], tally);
                }
            }
        }
        MESSAGE(target << ": " << tally.beams << " beams, " << tally.moved << " went on, " << tally.missed
                       << " missed; lowest f before an end " << tally.lowest << " of lipschitz * radius");
        CHECK(tally.violations == 0);
        CHECK(tally.moved * 3 > tally.beams);
        CHECK(tally.missed * 50 > tally.beams);
        CHECK((tally.beams - tally.moved) * 50 > tally.beams);
        // Also the search's power: where it looks a little beyond an end, it finds the surface.
        if (tally.gaps.empty()) return;
        MESSAGE("could have gone on by " << quantile(tally.gaps, 0.5) << " radii (median), "
                                         << quantile(tally.gaps, 0.1) << " to " << quantile(tally.gaps, 0.9)
                                         << " (10 to 90 %), of " << tally.gaps.size() << " beams");
        CHECK(quantile(tally.gaps, 0.5) <= 6.0);
    });
}

TEST_CASE("a beam's end has the same bits in batches of 1 to 64, in any order, beside far beams, on every target") {
    on_every_target([](const std::string&) {
        Random random(72);
        for (int i = 0; i < 24; ++i) {
            const scene::Surface surface = beam_surface(random, i);
            const trace::Field field(surface);
            const trace::BeamTracer tracer(field);
            std::vector<Beam> beams = hard_beams(random, field, 96);
            // Beams beyond the first block of the hash, and beams that have ended before they begin.
            for (std::size_t k = 0; k < beams.size(); k += 19) {
                beams[k].origin += glm::dvec3(0x1p31 / surface.frequency, 0.0, 0.0);
                beams[(k + 5) % beams.size()].limit = beams[(k + 5) % beams.size()].start;
            }
            std::vector<BeamEnd> alone(beams.size());
            trace::TraceCounters alone_work;
            for (std::size_t k = 0; k < beams.size(); ++k) {
                tracer.trace({&beams[k], 1}, {&alone[k], 1}, alone_work);
            }
            std::vector<std::size_t> order(beams.size());
            std::iota(order.begin(), order.end(), std::size_t{0});
            int different = 0;
            for (int round = 0; round < 3; ++round) {
                trace::TraceCounters work;
                for (std::size_t begin = 0, size = 1; begin < beams.size(); begin += size, size = 1 + random() % 64) {
                    size = std::min(size, beams.size() - begin);
                    std::vector<Beam> batch;
                    for (std::size_t k = begin; k < begin + size; ++k) batch.push_back(beams[order[k]]);
                    const std::vector<BeamEnd> ends = ends_of(tracer, batch, work);
                    for (std::size_t k = 0; k < size; ++k) different += !same(ends[k], alone[order[begin + k]]);
                }
                CHECK(work.noise_evaluations == alone_work.noise_evaluations);
                CHECK(work.steps == alone_work.steps);
                CHECK(work.executed_lanes >= work.noise_evaluations);
                std::shuffle(order.begin(), order.end(), random);
            }
            CHECK(different == 0);
        }
    });
}

TEST_CASE("without octaves a beam ends, or misses, where the rim of its bundle meets the plane, by algebra") {
    on_every_target([](const std::string& target) {
        Random random(73);
        scene::Surface flat = surface_of(solid::kKind<solid::DisplacedPlane>);
        flat.amplitude = 0.0;
        const trace::Field field(flat);
        const trace::BeamTracer tracer(field);
        double shortest = 1.0, longest = 0.0;
        int met = 0, missed = 0;
        for (int trial = 0; trial < 4000; ++trial) {
            Beam beam;
            beam.origin = {uniform(random, -50.0, 50.0), log_uniform(random, 1e-2, 10.0), uniform(random, -50.0, 50.0)};
            beam.direction = unit_vector(random);
            beam.spread = random() % 4 == 0 ? 0.0 : log_uniform(random, 1e-4, 0.5);
            if (random() % 2 == 0) beam.radius0 = uniform(random, 0.0, 0.9) * beam.origin.y;
            beam.limit = 1000.0;
            // The height of the lowest point at axis coordinate s: height + s d.y - (radius0 + spread s) sideways.
            const double sideways = std::hypot(beam.direction.x, beam.direction.z);
            const double fall = beam.spread * sideways - beam.direction.y;
            const double height = beam.origin.y - beam.radius0 * sideways;
            const double exact = fall > 0.0 ? height / fall : std::numeric_limits<double>::infinity();
            const BeamEnd end = ends_of(tracer, {&beam, 1}).front();
            if (exact >= 1.001 * beam.limit) {
                CHECK(end.misses);
                ++missed;
            } else if (exact < beam.limit) {
                CHECK(!end.misses);
                shortest = std::min(shortest, end.s / exact);
                longest = std::max(longest, end.s / exact);
                ++met;
            }
        }
        MESSAGE(target << ": " << met << " met, " << missed << " missed; ends at " << shortest << " to 1 + "
                       << longest - 1.0 << " of the exact distance");
        // Beams without width end where double cannot tell the distance any more; nor can the formula.
        CHECK(longest <= 1.0 + 1e-13);
        CHECK(met > 1000);
        CHECK(missed > 500);
    });
}

TEST_CASE("a beam that starts at or beyond its limit, or within the surface, stays where it starts") {
    Random random(74);
    int inside = 0;
    for (int i = 0; i < 16; ++i) {
        const scene::Surface surface = beam_surface(random, i);
        const trace::Field field(surface);
        const trace::BeamTracer tracer(field);
        for (Beam beam : hard_beams(random, field, 64)) {
            const glm::dvec3 x = beam.origin + beam.start * beam.direction;
            const oracle::FieldOracle expected(oracle::shape_of(surface, 0.0));
            if (!field.drifts() && expected.value({x.x, x.y, x.z}) < -1e-9) {
                ++inside;
                const BeamEnd end = ends_of(tracer, {&beam, 1}).front();
                CHECK(end.s == beam.start);
                CHECK(!end.misses);
            }
            beam.start = beam.limit * uniform(random, 1.0, 2.0);
            const BeamEnd end = ends_of(tracer, {&beam, 1}).front();
            CHECK(end.s == beam.start);
            CHECK(end.misses);
        }
    }
    CHECK(inside > 30);
}

TEST_CASE("of every point that a beam looks at each octave is evaluated or left out as too fine") {
    Random random(82);
    for (int i = 0; i < 16; ++i) {
        const trace::Field field(beam_surface(random, i));
        trace::TraceCounters counters;
        ends_of(trace::BeamTracer(field), hard_beams(random, field, 100), counters);
        CHECK(counters.noise_evaluations + counters.left_out.too_fine == counters.steps * field.octaves().size());
    }
}
