// That a golden scene stands for everything there is, and that no change of a bit or a count passes unseen.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shaders_cpu/scene_parts.h"
#include "src/integrate/channels.h"
#include "src/scene/enum_names.h"
#include "src/scene/relief_keys.h"
#include "tests/golden/check.h"
#include "tests/golden/pins.h"
#include "tests/golden/reference_picture.h"
#include "tests/image/scratch_folder.h"

using namespace strata;
using namespace strata::golden;

namespace {

GoldenScene scene_named(const std::string& name) {
    for (const GoldenScene& golden : golden_scenes()) {
        if (golden.name == name) return golden;
    }
    throw PinError("no golden scene is called " + name);
}

// The names in `all` that no golden scene picks.
template <class E, class Pick>
std::set<std::string_view> left_out(Pick pick) {
    std::set<std::string_view> names(scene::kEnumNames<E>.begin(), scene::kEnumNames<E>.end());
    for (const GoldenScene& golden : golden_scenes()) names.erase(scene::name_of(pick(scene_of(golden))));
    return names;
}

// As if the scene had been rendered so: written down, read back and held against `got`.
std::vector<std::string> differences_from_pinned(const Record& pinned, const Record& got) {
    const Pins pins{{"a", "b", "c"}, {{"scene", pinned}}};
    return differences(parse_pins(print_pins(pins, "scalar"), "test").scenes.at("scene"), got);
}

}  // namespace

TEST_CASE("every kind of image, surface, bound, camera path and estimator has a golden scene") {
    CHECK(left_out<scene::ImageKind>([](const scene::Scene& s) { return s.image; }).empty());
    CHECK(left_out<solid::Kind>([](const scene::Scene& s) { return s.surface.kind; }).empty());
    CHECK(left_out<solid::LevelSet::Bound>([](const scene::Scene& s) {
              return s.surface.shape<solid::LevelSet>().bound;
          }).empty());
    CHECK(left_out<scene::Interpolation>([](const scene::Scene& s) { return s.camera.interpolation; }).empty());
    CHECK(left_out<scene::EstimatorKind>([](const scene::Scene& s) { return s.sampling.estimator; }).empty());
}

TEST_CASE("every type of relief term has a golden scene") {
    const auto types = scene::relief_types();
    std::set<std::string_view> left(types.begin(), types.end());
    for (const GoldenScene& golden : golden_scenes()) {
        for (const noise::ReliefTerm& term : scene_of(golden).surface.relief) left.erase(types[term.node.index()]);
    }
    CHECK(left.empty());
}

TEST_CASE("every light, background, medium, material and channel has a golden scene") {
    std::set<std::string> left;
    for (const shaders::ScenePart& part : shaders::scene_parts({})) left.insert(part.name);
    for (const integrate::Channel& channel : integrate::all_channels())
        left.insert("--aov " + std::string(channel.name));
    for (const GoldenScene& golden : golden_scenes()) {
        for (const std::string& channel : golden.channels) left.erase("--aov " + channel);
        const scene::Scene scene = scene_of(golden);
        if (scene.image != scene::ImageKind::surface) continue;
        for (const shaders::ScenePart& part : shaders::scene_parts(scene)) {
            if (part.is_needed) left.erase(part.name);
        }
    }
    for (const std::string& name : left) FAIL_CHECK("no golden scene has " << name);
}

TEST_CASE("golden scenes have names of their own and every phase of a render works in one of them") {
    std::set<std::string> names, idle;
    for (std::size_t i = 0; i < integrate::kPhases; ++i) {
        // Shading evaluates no noise.
        if (static_cast<integrate::Phase>(i) == integrate::Phase::shading) continue;
        idle.insert(phase_key(static_cast<integrate::Phase>(i)) + ".evaluations");
    }
    for (const GoldenScene& golden : golden_scenes()) {
        CHECK(names.insert(golden.name).second);
        for (const auto& [name, count] : measure(golden, kPinnedCut).record.counts) {
            if (count > 0) idle.erase(name);
        }
    }
    CHECK(names.size() >= 32);
    for (const std::string& name : idle) FAIL_CHECK(name << " is 0 in all golden scenes");
}

TEST_CASE("a change of one pixel by one ulp differs from what is pinned, and its pixel is found") {
    const GoldenScene golden = scene_named("random_edge");
    const Measurement pinned = measure(golden, kPinnedCut);
    CHECK(differences_from_pinned(pinned.record, pinned.record).empty());

    Measurement changed = pinned;
    float& value = changed.picture.rgb[changed.picture.rgb.size() / 2];
    value = std::nextafter(value, std::numeric_limits<float>::infinity());
    changed.record.digests[0].second = pixels_digest(changed.picture);
    const std::vector<std::string> lines = differences_from_pinned(pinned.record, changed.record);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].starts_with("pixels: expected " + pinned.record.digests[0].second + ", got "));

    const PictureChange change = change_between(reference_of(pinned.picture), reference_of(changed.picture));
    CHECK(change.pixels == 1);
    CHECK(change.largest_code == 0);
}

TEST_CASE("each digest and each count that changes by one, comes or goes is named") {
    const Record pinned = measure(scene_named("terrain_aov"), kPinnedCut).record;
    REQUIRE(pinned.digests.size() == 3);
    for (std::size_t i = 0; i < pinned.digests.size(); ++i) {
        Record changed = pinned;
        changed.digests[i].second.back() ^= 1;
        const auto lines = differences_from_pinned(pinned, changed);
        REQUIRE(lines.size() == 1);
        CHECK(lines[0].starts_with(pinned.digests[i].first + ": "));
    }
    for (std::size_t i = 0; i < pinned.counts.size(); ++i) {
        Record changed = pinned;
        ++changed.counts[i].second;
        const auto lines = differences_from_pinned(pinned, changed);
        REQUIRE(lines.size() == 1);
        CHECK(lines[0].starts_with(pinned.counts[i].first + ": "));
    }
    Record more = pinned;
    more.counts.emplace_back("new.steps", 5);
    CHECK(differences_from_pinned(pinned, more) == std::vector<std::string>{"new.steps: expected 0, got 5"});
    CHECK(differences_from_pinned(more, pinned) == std::vector<std::string>{"new.steps: expected 5, got 0"});
}

TEST_CASE("a mismatch fails where compiler and maths library are those of the pins, and leaves three pictures") {
    const ScratchFolder scratch;
    const Folders folders{scratch / "pins", scratch / "left"};
    const std::vector<GoldenScene> scenes{scene_named("random_edge"), scene_named("none_zoneplate")};
    pin(kReferenceTarget, scenes, folders);
    CHECK(check(kReferenceTarget, scenes, folders) == Verdict::same);
    CHECK(!std::filesystem::exists(folders.left / kReferenceTarget));

    Pins pins = load_pins(pins_path(folders, kReferenceTarget));
    pins.scenes.at("random_edge").digests[0].second = "0123456789abcdef";
    const auto check_against = [&](const Pins& changed) {
        write_bytes(pins_path(folders, kReferenceTarget), print_pins(changed, kReferenceTarget));
        return check(kReferenceTarget, scenes, folders);
    };
    CHECK(check_against(pins) == Verdict::differs);
    for (const char* name : {"render.exr", "expected.png", "difference.png"}) {
        CHECK(std::filesystem::exists(folders.left / kReferenceTarget / "random_edge" / name));
    }
    CHECK(!std::filesystem::exists(folders.left / kReferenceTarget / "none_zoneplate"));

    Pins elsewhere = pins;
    elsewhere.environment.libm = "another";
    CHECK(check_against(elsewhere) == Verdict::differs_elsewhere);
    elsewhere = pins;
    elsewhere.environment.compiler = "another";
    CHECK(check_against(elsewhere) == Verdict::differs_elsewhere);
    elsewhere = pins;
    elsewhere.environment.libc = "another, with the same bits";
    CHECK(check_against(elsewhere) == Verdict::differs);

    pins = load_pins(pins_path(folders, kReferenceTarget));
    pins.scenes.erase("random_edge");
    CHECK(check_against(pins) == Verdict::differs);
    pin(kReferenceTarget, scenes, folders);
    CHECK(check(kReferenceTarget, std::span(scenes).first(1), folders) == Verdict::differs);
}

TEST_CASE("expected pictures come back from their text, and damaged text is refused") {
    const ReferencePicture reference = reference_of(measure(scene_named("planet_shared_crop"), kPinnedCut).picture);
    const std::string text = print_reference(reference);
    const ReferencePicture back = parse_reference(text, "test");
    CHECK(back.width == reference.width);
    CHECK(back.height == reference.height);
    CHECK(back.bytes == reference.bytes);

    const std::size_t first = text.find('\n') + 1;
    std::string letters = text;
    letters[first] = '?';
    const std::string shorter = text.substr(0, first) + text.substr(first + 1);
    const std::string rows_missing = text.substr(0, text.find('\n', first) + 1), rows_more = text + text.substr(first);
    for (const std::string& damaged : {std::string("17"), letters, shorter, rows_missing, rows_more}) {
        CHECK_THROWS_AS(parse_reference(damaged, "test"), PinError);
    }
}

TEST_CASE("damaged pins are refused with their file's name") {
    const std::string good = "[environment]\ncompiler = \"a\"\nlibm = \"b\"\nlibc = \"c\"\n[scene]\n";
    CHECK(parse_pins(good, "test").scenes.size() == 1);
    for (const std::string& damaged :
         {std::string("[scene]\n"), std::string("x = 1\n"), good + "rays = 3\n", good + "rays = { steps = -1 }\n",
          good + "rays = { steps = \"1\" }\n", good + "rays = {\n"}) {
        CHECK_THROWS_WITH_AS(parse_pins(damaged, "test"), doctest::Contains("test"), PinError);
    }
    CHECK_THROWS_WITH_AS(load_pins("/nowhere/avx2.toml"), doctest::Contains("/nowhere/avx2.toml"), PinError);
}
