#include "tests/golden/check.h"

#include <fmt/format.h>

#include <set>
#include <span>

#include "src/image/output_file.h"
#include "tests/golden/pins.h"
#include "tests/golden/reference_picture.h"

namespace strata::golden {

namespace {

std::filesystem::path picture_path(const Folders& folders, const std::string& scene) {
    return folders.pins / "pictures" / (scene + ".txt");
}

void replace_text(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    image::replace_file(path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

// What the pixels of another cut into work have that those of the pinned one have not.
std::vector<std::string> differences_between_cuts(const GoldenScene& golden, const Measurement& pinned) {
    Record other = measure(golden, kOtherCut).record;
    other.counts = pinned.record.counts;
    std::vector<std::string> lines;
    for (const std::string& line : differences(pinned.record, other)) {
        lines.push_back(fmt::format("with {} threads and tiles of {}, {}", kOtherCut.threads, kOtherCut.tile, line));
    }
    return lines;
}

std::string pictures_line(const std::string& target, const Folders& folders, const GoldenScene& golden,
                          const Measurement& got) {
    const std::filesystem::path folder = folders.left / target / golden.name;
    const std::filesystem::path expected = picture_path(folders, golden.name);
    std::string line = leave_pictures(folder, got.picture, load_reference(expected));
    if (target != kReferenceTarget) line += fmt::format(" (which is that of {})", kReferenceTarget);
    return fmt::format("{}\n    render.exr, expected.png and difference.png are in {}", line, folder.string());
}

void print(const std::string& target, const std::string& scene, const std::vector<std::string>& lines) {
    fmt::print("{} on {}:\n", scene, target);
    for (const std::string& line : lines) fmt::print("    {}\n", line);
}

// Whether the scene is as it was pinned; prints what is not.
bool agrees(const std::string& target, const Folders& folders, const GoldenScene& golden, const Pins& pins,
            const Measurement& got) {
    const auto pinned = pins.scenes.find(golden.name);
    if (pinned == pins.scenes.end()) {
        print(target, golden.name, {"not pinned yet; tests/golden/pin does it"});
        return false;
    }
    std::vector<std::string> lines = differences(pinned->second, got.record);
    if (!lines.empty()) lines.push_back(pictures_line(target, folders, golden, got));
    const std::vector<std::string> cuts = differences_between_cuts(golden, got);
    lines.insert(lines.end(), cuts.begin(), cuts.end());
    if (!lines.empty()) print(target, golden.name, lines);
    return lines.empty();
}

// Pinned scenes that are none any more.
int count_gone(const std::string& target, std::span<const GoldenScene> scenes, const Pins& pins) {
    std::set<std::string> names;
    for (const GoldenScene& golden : scenes) names.insert(golden.name);
    int gone = 0;
    for (const auto& [name, record] : pins.scenes) {
        if (names.contains(name)) continue;
        print(target, name, {"pinned, but no longer a scene"});
        ++gone;
    }
    return gone;
}

void remove_old_pictures(const Folders& folders, const Pins& pins) {
    for (const auto& entry : std::filesystem::directory_iterator(folders.pins / "pictures")) {
        if (!pins.scenes.contains(entry.path().stem().string())) std::filesystem::remove(entry.path());
    }
}

}  // namespace

std::filesystem::path pins_path(const Folders& folders, const std::string& target) {
    return folders.pins / (target + ".toml");
}

Verdict check(const std::string& target, std::span<const GoldenScene> scenes, const Folders& folders) {
    std::filesystem::remove_all(folders.left / target);
    const Pins pins = load_pins(pins_path(folders, target));
    int differ = count_gone(target, scenes, pins);
    for (const GoldenScene& golden : scenes) {
        differ += !agrees(target, folders, golden, pins, measure(golden, kPinnedCut));
    }
    fmt::print("{}: {} scenes, {} not as pinned\n", target, scenes.size(), differ);
    if (differ == 0) return Verdict::same;
    const std::string why = what_differs(pins.environment, this_environment());
    if (why.empty()) {
        fmt::print("If every change above is meant, pin it: tests/golden/pin\n");
        return Verdict::differs;
    }
    fmt::print("No verdict: {}.\n", why);
    return Verdict::differs_elsewhere;
}

void pin(const std::string& target, std::span<const GoldenScene> scenes, const Folders& folders) {
    std::filesystem::remove_all(folders.left / target);
    Pins before;
    if (std::filesystem::exists(pins_path(folders, target))) before = load_pins(pins_path(folders, target));
    Pins now{this_environment(), {}};
    int changed = count_gone(target, scenes, before);
    for (const GoldenScene& golden : scenes) {
        const Measurement got = measure(golden, kPinnedCut);
        changed += !agrees(target, folders, golden, before, got);
        now.scenes[golden.name] = got.record;
        if (target == kReferenceTarget) {
            replace_text(picture_path(folders, golden.name), print_reference(reference_of(got.picture)));
        }
    }
    replace_text(pins_path(folders, target), print_pins(now, target));
    if (target == kReferenceTarget) remove_old_pictures(folders, now);
    fmt::print("{}: {} scenes pinned, {} new, changed or gone\n", target, now.scenes.size(), changed);
}

}  // namespace strata::golden
