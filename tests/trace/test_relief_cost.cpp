// What each kind of relief term costs: noise evaluations a ray, exact counts of one fixed bundle of rays, against an
// fBm of as many octaves, the same frequency and about the same height. The table is printed; a few ratios are
// promised.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <map>

#include "src/trace/fast_tracer.h"
#include "tests/trace/relief_families.h"

namespace {

using namespace strata;

struct Cost {
    double evaluations, steps;
};

// A fan of rays from above the ground, from steep ones to ones over the horizon, with a tolerance that grows like
// pixels.
Cost cost_of(const std::vector<noise::ReliefTerm>& terms) {
    scene::Surface surface;
    surface.relief = terms;
    const trace::Field field(surface);
    const trace::FastTracer tracer(field);
    std::vector<trace::Ray> rays;
    for (int i = 0; i < 64; ++i) {
        for (int j = 0; j < 64; ++j) {
            const glm::dvec3 to{0.7 * (i - 31.5) / 32.0, 0.2 - 0.6 * (j + 0.5) / 64.0, 1.0};
            rays.push_back({.origin = {0.0, field.relief()->certificate().high + 0.3, 0.0},
                            .direction = glm::normalize(to),
                            .limit = 60.0,
                            .delta0 = 0.0,
                            .delta_slope = 1e-4});
        }
    }
    std::vector<trace::Hit> hits(rays.size());
    trace::TraceCounters counters;
    tracer.trace(rays, hits, counters);
    const auto count = static_cast<double>(rays.size());
    return {static_cast<double>(counters.noise_evaluations) / count, static_cast<double>(counters.steps) / count};
}

noise::FbmParameters octaves(int count) {
    return {.octaves = count, .lacunarity = 2.0, .gain = 0.5, .amplitude = 0.8, .frequency = 0.4, .seed = 3};
}

using Terms = std::vector<noise::ReliefTerm>;

Terms over_hills(noise::ReliefNode node, int count) {
    return {{"hills", {}, noise::Fbm{octaves(count)}}, {"it", {"hills"}, std::move(node)}};
}

Terms of_two(noise::ReliefNode node) {
    noise::FbmParameters other = octaves(3);
    other.seed = 4;
    return {{"a", {}, noise::Fbm{octaves(3)}}, {"b", {}, noise::Fbm{other}}, {"it", {"a", "b"}, std::move(node)}};
}

// Kinds with their terms, and how many octaves the fBm has that each is held against.
struct Row {
    std::string name;
    Terms terms;
    int octaves;
};

std::vector<Row> rows() {
    noise::Craters craters{octaves(6)};
    craters.size = 2.5;
    craters.parameters = {.octaves = 6, .lacunarity = 2.0, .gain = 1.0, .amplitude = 1.0};
    noise::Gullies few, many;
    few.parameters.octaves = 3;
    many.parameters.octaves = 6;
    few.branching = many.branching = 0.0;
    noise::Gullies branched = few;
    branched.branching = 1.0;
    noise::Gullies third = many;
    third.branching = 0.3;
    noise::Fbm turned{octaves(6), 36.87};
    std::vector<Row> all{
        {"fbm, 6 octaves", {{"it", {}, noise::Fbm{octaves(6)}}}, 6},
        {"fbm, 6 turned octaves", {{"it", {}, turned}}, 6},
        {"ridged, no feedback", {{"it", {}, noise::Ridged{octaves(6), 0.05, 0.0}}}, 6},
        {"ridged", {{"it", {}, noise::Ridged{octaves(6), 0.05, 1.5}}}, 6},
        {"billow", {{"it", {}, noise::Billow{octaves(6), 0.05, 0.0}}}, 6},
        {"hybrid", {{"it", {}, noise::Hybrid{octaves(6), 2.0}}}, 6},
        {"warp of fbm, 6 + 2", over_hills(noise::Warp{}, 6), 6},
        {"curve of fbm, 6", over_hills(noise::Curve{}, 6), 6},
        {"terraces of fbm, 6", over_hills(noise::Terraces{}, 6), 6},
        {"fill of fbm, 6", over_hills(noise::Fill{}, 6), 6},
        {"envelope of fbm, 6", over_hills(noise::Envelope{}, 6), 6},
        {"product, 3 + 3", of_two(noise::Product{}), 6},
        {"highest, 3 + 3", of_two(noise::Highest{}), 6},
        {"lowest, 3 + 3", of_two(noise::Lowest{}), 6},
        {"blend, 3 + 3", of_two(noise::Blend{-0.2, 0.2}), 6},
        {"dunes, 2 + 1", {{"it", {}, noise::Dunes{}}}, 3},
        {"craters, 6", {{"it", {}, craters}}, 6},
        {"gullies of fbm, 3 + 3", over_hills(few, 3), 6},
        {"gullies, branching, 3 + 3", over_hills(branched, 3), 6},
        {"gullies of fbm, 6 + 3", over_hills(many, 3), 9},
        {"gullies, a third, 6 + 3", over_hills(third, 3), 9},
    };
    return all;
}

}  // namespace

TEST_CASE("ridged and hybrid reliefs cost hardly more than an fBm of as many octaves") {
    std::map<int, Cost> fbm;
    std::map<std::string, double> ratio;
    std::string table = fmt::format("\n{:<28}{:>14}{:>10}{:>14}\n", "", "evaluations", "steps", "against fBm");
    for (const Row& row : rows()) {
        if (!fbm.contains(row.octaves)) fbm[row.octaves] = cost_of({{"it", {}, noise::Fbm{octaves(row.octaves)}}});
        const Cost cost = cost_of(row.terms);
        ratio[row.name] = cost.evaluations / fbm[row.octaves].evaluations;
        table +=
            fmt::format("{:<28}{:>14.1f}{:>10.1f}{:>14.2f}\n", row.name, cost.evaluations, cost.steps, ratio[row.name]);
    }
    MESSAGE(table);
    CHECK(ratio["fbm, 6 octaves"] == 1.0);
}
