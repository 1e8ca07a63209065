// Zones of bundles: outside of them no ray of the bundle meets the surface, however the zones came about.
#include "src/accel/zones.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/trace/fast_tracer_cases.h"
#include "tests/trace/relief_families.h"

using namespace strata;
using namespace strata::accel;
using namespace strata::trace_test;

namespace {

// A cone about some direction from some eye, now and then as though eye and noise had moved.
CellBeam cone_about(Random& random, const trace::Field& field, const trace::Ray& ray) {
    CellBeam cell;
    cell.beam.spread = log_uniform(random, 1e-3, 0.1);
    cell.beam.direction = ray.direction;
    if (random() % 4 == 0) cell.beam.radius0 = log_uniform(random, 1e-4, 1e-1);
    if (field.drifts() && random() % 2 == 0) cell.beam.noise_radius = log_uniform(random, 1e-4, 1e-1);
    cell.beam.origin = ray.origin - cell.beam.radius0 * ray.direction;
    cell.beam.noise_shift = ray.noise_shift;
    cell.beam.limit = ray.limit + 2.0 * cell.beam.radius0;
    cell.margins = {2.0 * cell.beam.radius0, 1.0 / std::sqrt(1.0 + cell.beam.spread * cell.beam.spread)};
    return cell;
}

// A narrower cone within it.
CellBeam cone_within(Random& random, const CellBeam& cell) {
    CellBeam inner = cell;
    inner.beam.spread = cell.beam.spread * uniform(random, 0.1, 0.4);
    const glm::dvec3 across = glm::normalize(glm::cross(cell.beam.direction, unit_vector(random)));
    inner.beam.direction =
        glm::normalize(cell.beam.direction + 0.5 * cell.beam.spread * uniform(random, 0.0, 1.0) * across);
    inner.beam.origin = cell.beam.origin + cell.beam.radius0 * (cell.beam.direction - inner.beam.direction);
    inner.margins.cosine = 1.0 / std::sqrt(1.0 + inner.beam.spread * inner.beam.spread);
    return inner;
}

trace::Ray ray_within(Random& random, const CellBeam& cell) {
    const trace::Beam& beam = cell.beam;
    const glm::dvec3 across = glm::normalize(glm::cross(beam.direction, unit_vector(random)));
    trace::Ray ray;
    ray.origin = beam.origin + beam.radius0 * beam.direction + 0.999 * beam.radius0 * unit_vector(random);
    ray.direction = glm::normalize(beam.direction + 0.999 * beam.spread * uniform(random, 0.0, 1.0) * across);
    ray.noise_shift = beam.noise_shift + 0.999 * beam.noise_radius * unit_vector(random);
    return ray;
}

bool is_in_zone(const ZoneList& zones, double s) {
    return std::ranges::any_of(zones.all(), [&](const Zone& zone) { return s >= zone.from && s <= zone.to; });
}

// The field's double arithmetic is off by less.
double rounding(const trace::Ray& ray, double s) {
    return 1e-12 * (1.0 + s + glm::length(ray.origin) + glm::length(ray.noise_shift));
}

struct Found {
    std::size_t bundles = 0, zones = 0, parted = 0, points = 0, inside = 0;
};

// Of points outside of the zones none may be inside the surface; of the others some are.
void check_zones(Random& random, const trace::Field& field, const ZonedBundle& bundle, Found& found) {
    ++found.bundles;
    found.zones += bundle.zones.count;
    found.parted += bundle.zones.count > 1;
    for (std::size_t i = 1; i < bundle.zones.count; ++i) {
        CHECK(bundle.zones.zones[i - 1].to <= bundle.zones.zones[i].from);
    }
    for (int i = 0; i < 12; ++i) {
        const trace::Ray ray = ray_within(random, bundle.cell);
        for (int j = 0; j < 12; ++j) {
            double s = uniform(random, 0.0, 1.0) * bundle.cell.beam.limit;
            // Every other one right at the edge of a zone.
            if (j % 2 == 0 && bundle.zones.count > 0) {
                const Zone& zone = bundle.zones.zones[random() % bundle.zones.count];
                const double off = log_uniform(random, 1e-9, 1e-2) * (1.0 + zone.from);
                s = random() % 2 == 0 ? zone.from - off : std::min(zone.to, bundle.cell.beam.limit) + off;
            }
            if (s < 0.0 || s > bundle.cell.beam.limit - bundle.cell.margins.shift) continue;
            const double f = field.value(ray.origin + s * ray.direction, ray.noise_shift);
            if (is_in_zone(bundle.zones, s)) {
                found.inside += f < 0.0;
            } else {
                ++found.points;
                CHECK(f > -rounding(ray, s));
            }
        }
    }
}

std::vector<scene::Surface> zone_surfaces(Random& random, int count) {
    std::vector<scene::Surface> all = surfaces(random, count);
    for (int i = 0; i < count / 4; ++i) {
        all.push_back(random_drifting_surface(random));
        all.push_back(random_composed_surface(random));
    }
    return all;
}

}  // namespace

TEST_CASE("no ray of a bundle meets the surface outside of its zones, nor of those of narrower bundles within it") {
    Random random(20061201);
    Found outer, inner;
    for (const scene::Surface& surface : zone_surfaces(random, 24)) {
        const trace::Field field(surface);
        const trace::FastTracer rays(field);
        const trace::BeamTracer beams(field);
        CAPTURE(surface.seed);
        trace::TraceCounters counters;
        ZoneTracer zones;
        std::vector<ZonedBundle> bundles;
        for (const trace::Ray& ray : hard_rays(random, field, rays, 40)) {
            ZonedBundle& bundle = bundles.emplace_back(ZonedBundle{cone_about(random, field, ray), {}});
            bundle.zones.put({});
        }
        zones.follow(beams, bundles, 24, counters);
        std::vector<ZonedBundle> narrower;
        for (const ZonedBundle& bundle : bundles) {
            check_zones(random, field, bundle, outer);
            for (int i = 0; i < 3; ++i) {
                if (bundle.zones.count > 0) narrower.push_back({cone_within(random, bundle.cell), bundle.zones});
            }
        }
        zones.follow(beams, narrower, static_cast<int>(random() % 3) * 12, counters);
        for (const ZonedBundle& bundle : narrower) check_zones(random, field, bundle, inner);
    }
    MESSAGE(outer.bundles << " bundles, " << outer.parted << " with several zones; " << inner.bundles
                          << " within them, " << inner.parted << " with several; " << outer.points + inner.points
                          << " points outside of zones, " << outer.inside + inner.inside
                          << " points in zones are inside the surface");
    CHECK(outer.parted * 10 > outer.bundles);
    CHECK(inner.parted * 20 > inner.bundles);
    CHECK(inner.points > 50000);
    CHECK(outer.inside + inner.inside > 5000);
}

TEST_CASE("a bundle's zones depend on that bundle alone") {
    Random random(20061202);
    scene::Surface surface = surface_of(solid::kKind<solid::DisplacedPlane>);
    surface.amplitude = 0.7;
    const trace::Field field(surface);
    const trace::BeamTracer beams(field);
    const trace::FastTracer rays(field);
    trace::TraceCounters counters;
    std::vector<ZonedBundle> together;
    for (const trace::Ray& ray : hard_rays(random, field, rays, 200)) {
        together.push_back({cone_about(random, field, ray), {}});
        together.back().zones.put({});
    }
    const std::vector<ZonedBundle> before = together;
    ZoneTracer zones;
    zones.follow(beams, together, 24, counters);
    for (std::size_t i = 0; i < before.size(); ++i) {
        ZonedBundle alone = before[i];
        zones.follow(beams, {&alone, 1}, 24, counters);
        REQUIRE(alone.zones.count == together[i].zones.count);
        for (std::size_t k = 0; k < alone.zones.count; ++k) {
            CHECK(alone.zones.zones[k].from == together[i].zones.zones[k].from);
            CHECK(alone.zones.zones[k].to == together[i].zones.zones[k].to);
        }
    }
}

TEST_CASE("more zones than a list holds are merged, and none of what they cover is lost") {
    Random random(20061203);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Zone> all;
        for (int i = 0; i < 1 + static_cast<int>(random() % 24); ++i) {
            const double from = 10.0 * i + uniform(random, 0.0, 3.0);
            all.push_back({from, from + uniform(random, 0.0, 6.0), from, 0.0f, 0.0f});
        }
        std::vector<Zone> shuffled = all;
        std::shuffle(shuffled.begin(), shuffled.end(), random);
        ZoneList list;
        for (const Zone& zone : shuffled) list.put(zone);
        CHECK(list.count == std::min(all.size(), ZoneList::kMost));
        for (const Zone& zone : all) {
            CHECK(is_in_zone(list, zone.from));
            CHECK(is_in_zone(list, zone.to));
        }
        for (std::size_t i = 1; i < list.count; ++i) CHECK(list.zones[i - 1].to <= list.zones[i].from);
        const double from = uniform(random, 0.0, 250.0);
        list.merge_from(from);
        for (const Zone& zone : all) CHECK(is_in_zone(list, zone.to));
        CHECK(std::ranges::count_if(list.all(), [&](const Zone& zone) { return zone.from >= from; }) <= 1);
    }
}
