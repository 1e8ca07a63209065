#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/image/scratch_folder.h"
#include "tools/bench/against.h"
#include "tools/bench/figures.h"
#include "tools/bench/report.h"
#include "tools/bench/subset.h"
#include "tools/bench/variants.h"
#include "tools/cli/errors.h"

namespace {

using namespace strata::tools::bench;
using namespace strata;
using doctest::Approx;

std::vector<Section> all_sections() {
    std::vector<Section> sections;
    for (const SectionName& name : section_names()) sections.push_back(name.section);
    return sections;
}

Measurement measured(const Case& what, double ns_a_ray, double evaluations_a_ray) {
    Measurement m{.what = what};
    m.counters.rays = 1000;
    m.counters.noise_evaluations = static_cast<std::uint64_t>(1000 * evaluations_a_ray);
    m.counters.steps = 5000;
    m.cpu_s = {3e-6 * ns_a_ray, 1e-6 * ns_a_ray, 2e-6 * ns_a_ray};
    m.wall_s = m.cpu_s;
    return m;
}

// Every case of a plan costs 100 ns and 10 evaluations a ray.
Results flat_results(const std::vector<Section>& sections) {
    Results results{.plan = make_plan({.sections = sections, .quick = false, .whole = false, .rays = {}}), .rounds = 3};
    for (const Case& what : results.plan.cases) results.measurements.push_back(measured(what, 100, 10));
    return results;
}

Measurement& of(Results& results, const std::string& id) {
    for (Measurement& m : results.measurements) {
        if (m.what.id() == id) return m;
    }
    FAIL("no case ", id);
    return results.measurements.front();
}

const Figure& named(const std::vector<Figure>& figures, const std::string& name) {
    for (const Figure& figure : figures) {
        if (figure.name == name) return figure;
    }
    FAIL("no figure ", name);
    return figures.front();
}

std::string write_json(const ScratchFolder& folder, const std::string& text) {
    const auto path = folder.path() / "earlier.json";
    std::ofstream(path) << text;
    return path.string();
}

}  // namespace

TEST_CASE("blocks are whole, aligned, inside the frame, and each there once") {
    for (const auto& [width, height] : {std::pair{1920, 1080}, {480, 270}, {3840, 2160}, {65, 64}, {1, 1}, {7, 4000}}) {
        for (const int samples : {1, 4, 9, 16, 100, 4096}) {
            for (const std::int64_t rays : {std::int64_t{1}, std::int64_t{300'000}, std::int64_t{4'000'000}}) {
                const Subset subset = subset_of(width, height, samples, {rays, 4}, {});
                REQUIRE_FALSE(subset.windows.empty());
                std::set<std::pair<int, int>> corners;
                std::int64_t pixels = 0;
                for (const film::Rect& w : subset.windows) {
                    REQUIRE((0 <= w.x0 && w.x0 < w.x1 && w.x1 <= width && 0 <= w.y0 && w.y0 < w.y1 && w.y1 <= height));
                    REQUIRE(corners.insert({w.x0, w.y0}).second);
                    pixels += std::int64_t{1} * w.width() * w.height();
                    if (subset.block == 0) continue;
                    REQUIRE((w.x0 % subset.block == 0 && w.y0 % subset.block == 0 && subset.block % kBlockUnit == 0));
                    REQUIRE((w.width() == subset.block || w.x1 == width));
                    REQUIRE((w.height() == subset.block || w.y1 == height));
                    REQUIRE(std::int64_t{1} * subset.block * subset.block * samples >= kBatchSamples);
                }
                CHECK(pixels == subset.pixels());
                CHECK(pixels <= std::int64_t{1} * width * height);
                if (subset.block == 0) CHECK(pixels == std::int64_t{1} * width * height);
            }
        }
    }
}

TEST_CASE("a subset is the same every time, another by another seed") {
    const auto corners = [](std::uint64_t seed) {
        std::set<std::pair<int, int>> all;
        for (const film::Rect& w : subset_of(1920, 1080, 100, {1'000'000, 16}, {seed, seed, seed, seed}).windows)
            all.insert({w.x0, w.y0});
        return all;
    };
    CHECK(corners(1).size() == 16);
    CHECK(corners(1) == corners(1));
    CHECK(corners(1) != corners(2));
}

TEST_CASE("all blocks of a frame can be had, and no more") {
    const Subset subset = blocks_of(480, 270, 64, 1000, 3);
    CHECK(subset.windows.size() == 40);
    CHECK(subset.pixels() == 480 * 270);
}

TEST_CASE("ids tell all cases apart, and marks tell those apart that ids do") {
    for (const bool quick : {false, true}) {
        const Plan plan = make_plan({.sections = all_sections(), .quick = quick, .whole = false, .rays = {}});
        std::set<std::string> ids, marks;
        for (const Case& what : plan.cases) {
            CHECK_MESSAGE(ids.insert(what.id()).second, what.id());
            marks.insert(what.mark());
        }
        // The same render under another name is one that another section holds against it.
        CHECK(marks.size() >= ids.size() - 3 * plan.subset_pairs.size());
        for (const Curve& curve : plan.curves) {
            for (const CurvePoint& point : curve.points) CHECK(ids.contains(point.id));
        }
        for (const FeaturePair& pair : plan.light) CHECK((ids.contains(pair.off) && ids.contains(pair.on)));
        for (const SubsetPair& pair : plan.subset_pairs) CHECK((ids.contains(pair.part) && ids.contains(pair.whole)));
    }
}

TEST_CASE("a mark changes with the scene, the pixels, the tracer and the threads") {
    Case what{"hyperterrain", hyperterrain().scene, blocks_of(960, 540, 64, 5, 1)};
    std::set<std::string> marks{what.mark()};
    Case other = what;
    other.scene.surface.gain += 1e-9;
    marks.insert(other.mark());
    other = what;
    other.subset = blocks_of(960, 540, 64, 6, 1);
    marks.insert(other.mark());
    other = what;
    other.tracer = integrate::Tracer::reference;
    marks.insert(other.mark());
    other = what;
    other.threads = 2;
    marks.insert(other.mark());
    CHECK(marks.size() == 5);
    CHECK(marks.contains(what.mark()));
}

TEST_CASE("figures are the ratios that their names say") {
    Results results = flat_results({Section::figures});
    const FigureCases cases = results.plan.figures;
    of(results, cases.reference) = measured(of(results, cases.reference).what, 9000, 300);
    of(results, cases.few_samples).cpu_s = {400e-6};
    of(results, cases.octaves).cpu_s = {130e-6};
    of(results, cases.planar).cpu_s = {45e-6};
    of(results, cases.spin_moving).cpu_s = {250e-6};
    of(results, cases.camera_moving).cpu_s = {500e-6};
    Measurement& shadows = of(results, cases.shadows);
    shadows.counters.shadow_rays = 500;
    shadows.cpu_s = {140e-6};  // 40 us more for 500 rays: 80 ns each
    results.peers = {{kPovrayGuaranteed, "", {80'000, 70'000, 75'000}}, {kEmbreeOne, "", {50, 60}}};
    results.memory = {{.id = kMemoryUsual, .peak_bytes = 150'000'000}, {.id = kMemoryHuge, .failure = "no room"}};
    if (!cases.two_threads.empty()) of(results, cases.two_threads).wall_s = {51e-6};

    const std::vector<Figure> figures = figures_of(results);
    const auto check = [&](const char* name, double value, Verdict verdict) {
        const Figure& figure = named(figures, name);
        REQUIRE_MESSAGE(figure.value.has_value(), name);
        CHECK_MESSAGE(*figure.value == Approx(value), name);
        CHECK_MESSAGE(figure.verdict() == verdict, name);
    };
    check("evaluations", 10, Verdict::aim);
    check("reference", 100.0 / 9000, Verdict::floor);
    check("reference ns", 30, Verdict::floor);
    check("POV-Ray", 100.0 / 70'000, Verdict::aim);
    check("Embree", 2, Verdict::floor);
    check("shadow ray", 0.8, Verdict::floor);
    check("octaves", 1.3, Verdict::floor);
    check("2-D noise", 0.45, Verdict::floor);
    check("samples", 0.25, Verdict::aim);
    check("turning", 2.5, Verdict::floor);
    check("flying", 5, Verdict::below);
    check("memory", 150e6, Verdict::floor);
    CHECK(named(figures, "memory, huge").verdict() == Verdict::not_measured);
    if (!cases.two_threads.empty()) check("threads", 100.0 / 51, Verdict::floor);
    // The medians' ratio is told beside it: here the main case's is twice its least.
    CHECK(*named(figures, "samples").of_medians == Approx(0.5));
}

TEST_CASE("figures without their cases are not measured, and say what to run") {
    for (const Figure& figure : figures_of(flat_results({}))) {
        CHECK(figure.verdict() == Verdict::not_measured);
        CHECK_MESSAGE(figure.note.starts_with("--only "), figure.name);
    }
}

TEST_CASE("verdicts honour the direction, and marks that are just met") {
    Figure figure{.name = "a", .meaning = "", .value = 1.9, .floor = 1.9, .aim = 1.97, .more_is_better = true};
    CHECK(figure.verdict() == Verdict::floor);
    figure.value = 1.97;
    CHECK(figure.verdict() == Verdict::aim);
    figure.value = 1.89;
    CHECK(figure.verdict() == Verdict::below);
    figure.more_is_better = false;
    CHECK(figure.verdict() == Verdict::aim);
    figure.aim.reset();
    CHECK(figure.verdict() == Verdict::floor);
}

TEST_CASE("an earlier run is compared by ratio, case by case") {
    Results then = flat_results({Section::octaves});
    const ScratchFolder folder;
    const std::string file = write_json(folder, json_report(then, figures_of(then), {}));
    const EarlierRun earlier = read_earlier(file);
    check_comparable(earlier, then.plan);
    REQUIRE(earlier.cases.size() == then.measurements.size());

    Results now = flat_results({Section::octaves, Section::reference});
    for (Measurement& m : now.measurements) {
        if (m.what.threads == 1) m = measured(m.what, 50, 40);
    }
    check_comparable(earlier, now.plan);
    const std::vector<Comparison> rows = compare(earlier, now.measurements);
    REQUIRE(rows.size() == then.measurements.size());
    for (const Comparison& row : rows) {
        CHECK(row.time_ratio == Approx(0.5));
        CHECK(row.median_ratio == Approx(0.5));
        CHECK(row.evaluations_ratio == Approx(4));
    }
    CHECK(*overall(rows).fast == Approx(0.5));
    CHECK_FALSE(overall(rows).reference.has_value());
}

TEST_CASE("the overall ratio is the geometric mean, the reference tracer's apart") {
    const Overall all = overall({{"a", 2, 1, 1}, {"b", 0.5, 1, 1}, {"c", 4, 1, 1}, {"d reference", 1.5, 1, 1}});
    CHECK(*all.fast == Approx(std::cbrt(4.0)));
    CHECK(*all.reference == Approx(1.5));
}

TEST_CASE("runs that cannot be compared are refused with the reason") {
    const ScratchFolder folder;
    Results results = flat_results({Section::octaves});
    const std::string good = json_report(results, {}, {});
    const auto reason = [&](const std::string& text) -> std::string {
        try {
            check_comparable(read_earlier(write_json(folder, text)), results.plan);
        } catch (const tools::cli::UsageError& error) {
            return error.what();
        }
        return "accepted";
    };
    const auto changed = [&](const auto& change) {
        auto json = nlohmann::json::parse(good);
        change(json);
        return json.dump();
    };
    CHECK(reason(good) == "accepted");
    CHECK(reason("{").find("is no JSON") != std::string::npos);
    CHECK(reason("[]").find("is no benchmark") != std::string::npos);
    CHECK(reason("{\"kind\": 3}").find("is no benchmark") != std::string::npos);
    CHECK(reason(changed([](auto& json) { json["format"] = 99; })).find("format 99") != std::string::npos);
    CHECK(reason(changed([](auto& json) { json["cases"][1]["mark"] = "0"; })).find("another scene") !=
          std::string::npos);
    CHECK(reason(changed([](auto& json) { json["cases"][1].erase("ns_per_ray"); })).find("ns_per_ray") !=
          std::string::npos);
    CHECK(reason(changed([](auto& json) { json["cases"][0]["ns_per_ray"] = -1; })).find("ns_per_ray") !=
          std::string::npos);
    CHECK(reason(changed([](auto& json) { json["cases"] = nlohmann::json::array(); })).find("no case") !=
          std::string::npos);
    CHECK(reason(changed([](auto& json) { json["cases"] = 7; })) != "accepted");
}

TEST_CASE("phases add up by name, and their shares are told and drawn") {
    std::vector<Phase> sum;
    add_phases(sum, {{"beams", 1, 10, 100}, {"rays", 3, 30, 300}});
    add_phases(sum, {{"rays", 2, 20, 200}, {"film", 2, 0, 0}});
    REQUIRE(sum.size() == 3);
    CHECK(sum[1].name == "rays");
    CHECK(sum[1].seconds == 5);
    CHECK(sum[1].steps == 50);
    CHECK(sum[1].noise_evaluations == 500);

    Results results = flat_results({Section::octaves});
    const std::size_t panels = plot_report(results).panels.size();
    for (Measurement& m : results.measurements) m.phases = sum;
    const tools::report::Plot plot = plot_report(results);
    tools::report::check_plot(plot);
    CHECK(plot.panels.size() > panels);
    CHECK(text_report(results, {}, {}).find("beams 12, rays 62, film 25") != std::string::npos);
    const auto json = nlohmann::json::parse(json_report(results, {}, {}));
    CHECK(json["cases"][0]["phases"][1]["share"].get<double>() == Approx(0.625));
    CHECK(json["cases"][0]["phases"][1]["evaluations_per_ray"].get<double>() == Approx(0.5));
}
