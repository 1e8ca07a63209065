#include "tools/bench/run.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include "tools/bench/peers.h"
#include "tools/bench/variants.h"
#include "tools/cli/process.h"

using namespace strata::tools::bench;
using namespace strata;

namespace {

bool measure_round(Measurement& m, const parallel::CancelToken& cancel) {
    CaseRound round(m.what);
    for (std::size_t piece = 0; piece < round.pieces(); ++piece) {
        if (!round.measure_piece(cancel, [](const parallel::Progress&) {})) return false;
    }
    round.add_to(m);
    return true;
}

}  // namespace

TEST_CASE("every round of a case does the same work, whatever the time") {
    Case what{"hyperterrain", hyperterrain().scene, blocks_of(64, 36, 16, 2, 1)};
    what.scene.film.width = 64;
    what.scene.film.height = 36;
    what.scene.sampling.N = 2;
    const parallel::CancelToken cancel;
    Measurement m{.what = what};
    REQUIRE(measure_round(m, cancel));
    const integrate::Counters first = m.counters;
    REQUIRE(measure_round(m, cancel));
    CHECK(m.cpu_s.size() == 2);
    CHECK(first.rays == static_cast<std::uint64_t>(what.subset.pixels()) * 4);
    CHECK(m.counters.noise_evaluations == first.noise_evaluations);
    CHECK(m.evaluations_a_ray() > 8);
    // Different work is noticed.
    m.what.scene.surface.octaves = 3;
    CHECK_THROWS_AS(measure_round(m, cancel), std::runtime_error);
}

TEST_CASE("a run that is cancelled in its second round keeps the first, of every case, and nothing of the second") {
    Case small{"hyperterrain", hyperterrain().scene, blocks_of(64, 36, 16, 2, 1)};
    small.scene.film.width = 64;
    small.scene.film.height = 36;
    small.scene.sampling.N = 2;
    Case other = small;
    other.scene_name = "another";
    Plan plan;
    plan.cases = {small, other};
    for (const int rounds_done : {0, 1, 2}) {
        parallel::CancelToken cancel;
        const auto show = [&](const parallel::Progress& progress) {
            if (progress.fraction > 0.5 * rounds_done + 0.1) cancel.request();
        };
        const Results results = run(plan, 2, show, cancel);
        CHECK(results.rounds == rounds_done);
        CHECK(results.measurements.size() == (rounds_done > 0 ? 2 : 0));
        for (const Measurement& m : results.measurements) CHECK(std::ssize(m.cpu_s) == rounds_done);
    }
}

TEST_CASE("POV-Ray's statistics are read, and what is no statistics is refused") {
    CHECK(povray_trace_seconds("  Trace Time:       0 hours  0 minutes 33 seconds (33.055 seconds)\n"
                               "              using 1 thread(s) with 16.306 CPU-seconds total\nPOV-Ray finished\n") ==
          doctest::Approx(16.306));
    CHECK_THROWS_AS(povray_trace_seconds("Bounding Time: 1 thread(s) with 2 CPU-seconds total"),
                    tools::cli::ProcessError);
}

TEST_CASE("POV-Ray's scene has every octave, halved and doubled, and our camera") {
    scene::Scene scene = hyperterrain().scene;
    const std::string text = povray_scene(scene);
    std::size_t octaves = 0;
    for (std::size_t at = text.find("*(2*n("); at != std::string::npos; at = text.find("*(2*n(", at + 1)) ++octaves;
    CHECK(octaves == 8);
    CHECK(text.find("0.0046874999999999998*(2*n(64*x+") != std::string::npos);
    CHECK(text.find("angle 50") != std::string::npos);
}
