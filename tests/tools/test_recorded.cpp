// What `strata render --stats` wrote, as `strata explain` reads it again.
#include "tools/explain/recorded.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "tests/image/scratch_folder.h"
#include "tools/cli/errors.h"
#include "tools/job/settings_mark.h"

using namespace strata::tools::explain;
using namespace strata::tools::job;
using namespace strata;
using tools::cli::UsageError;

TEST_CASE("records of other settings, of interrupted renders and of other programs are refused") {
    const ScratchFolder folder;
    const auto path = folder.path() / "stats.json";
    const auto record = [](const std::string& mark, double rays) {
        nlohmann::json json{{"scene", "s"},   {"settings_mark", mark}, {"simd_target", "avx2"},    {"threads", 2},
                            {"seconds", 1.5}, {"cpu_seconds", 3.0},    {"peak_memory_bytes", 1000}};
        int value = 0;
        for (const auto& [name, count] : integrate::kCounters) json[name] = ++value;
        json["rays"] = rays;
        return json.dump();
    };
    write_bytes(path, record("abc", 100));
    const Recorded one = read_recorded(path, "abc", 100);
    CHECK(one.passes == 1);
    double value = 0.0;
    for (const auto& [name, count] : integrate::kCounters) {
        ++value;
        if (is_predicted(count)) CHECK(one.costs.counts[count] == value);
    }
    CHECK(one.costs.peak_memory_bytes == 1000.0);
    write_bytes(path, record("abc", 500));
    const Recorded five = read_recorded(path, "abc", 100);
    CHECK(five.passes == 5);
    CHECK(five.costs.counts[&integrate::Counters::hits] == *one.costs.counts[&integrate::Counters::hits] / 5.0);
    const auto refused = [&](const char* words) {
        CHECK_THROWS_WITH_AS(read_recorded(path, "abc", 100), doctest::Contains(words), UsageError);
    };
    write_bytes(path, record("abd", 100));
    refused("another scene");
    write_bytes(path, record("abc", 99));
    refused("interrupted");
    write_bytes(path, record("abc", 150));
    refused("interrupted");
    write_bytes(path, "{}");
    refused("settings_mark");
    write_bytes(path, R"({"settings_mark": "abc", "scene": "s", "rays": "many"})");
    refused("'rays'");
    write_bytes(path, "not JSON");
    refused("not JSON");
    CHECK_THROWS_WITH_AS(read_recorded(folder.path() / "none", "abc", 100), doctest::Contains("cannot be read"),
                         UsageError);
}

TEST_CASE("a settings mark tells what changes the work, and nothing else") {
    const scene::Scene scene = scene::read_scene(scene::find_builtin("terrain")->text, "terrain");
    const std::string mark = settings_mark(whole_frame(scene));
    CHECK(mark.size() == 16);
    CHECK(mark == settings_mark(whole_frame(scene)));
    CHECK(mark != settings_mark(whole_frame(scene, integrate::Tracer::reference)));
    CHECK(mark != settings_mark({scene, {0, 0, 1, 1}}));
    scene::Scene other = scene;
    other.sampling.seed += 1;
    CHECK(mark != settings_mark({other, whole_frame(scene).window}));
    other = scene;
    other.title = "another";
    other.film.exposure = 1.0;
    other.film.tone = scene::ToneCurve::agx;
    other.film.white_balance.r = 1.1;
    other.film.saturation = 0.9;
    other.film.contrast = 1.2;
    CHECK(mark == settings_mark({other, whole_frame(scene).window}));
}
