#include "src/scene/override.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "src/scene/key_lookup.h"
#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/relief_keys.h"
#include "src/scene/toml_reader.h"

namespace strata::scene {

namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t";
    const auto first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

constexpr std::string_view kAllSeeds = "relief.seed";

// `relief.seed` is no key of a file: it moves the seeds of all terms by as much, so that those which share one go on
// sharing it.
void move_seeds(Scene& scene, std::string_view value) {
    std::uint64_t shift = 0;
    assign_value({.section = "relief", .name = "seed", .field = &shift, .range = {}, .unit = {}, .meaning = {}}, value);
    bool is_any = false;
    for (noise::ReliefTerm& term : scene.surface.relief) {
        Section keys = describe_relief_term(term);
        const Key* key = find_key(keys, "seed");
        if (!key) continue;
        std::uint64_t& seed = *std::get<std::uint64_t*>(key->field);
        if (shift > kLargestSeed - seed) throw SceneError(fmt::format("{}: out of range ({})", kAllSeeds, value));
        seed += shift;
        is_any = true;
    }
    if (!is_any) throw SceneError(fmt::format("{}: the scene has no [[relief]], allowed: surface.seed", kAllSeeds));
}

void assign(Scene& scene, std::string_view assignment) {
    const auto equals = assignment.find('=');
    if (equals == std::string_view::npos) {
        throw SceneError("no '=', allowed: section.key=value, such as camera.fov_deg=35");
    }
    const std::string_view path = trimmed(assignment.substr(0, equals));
    if (path == kAllSeeds) return move_seeds(scene, trimmed(assignment.substr(equals + 1)));
    const auto [section_name, name] = key_path(path);
    const std::vector<Section> sections = describe(scene);
    const Section* section = find_section(sections, section_name);
    const Key* key = section ? find_key(*section, name) : nullptr;
    if (!key) throw SceneError(unknown_key(sections, section_name, name));
    assign_value(*key, trimmed(assignment.substr(equals + 1)));
}

}  // namespace

void apply_override(Scene& scene, std::string_view assignment, std::string_view option) {
    const std::string typed = option.empty() ? fmt::format("--set {}", excerpt(assignment)) : std::string(option);
    Scene changed = scene;
    try {
        assign(changed, assignment);
    } catch (const SceneError& error) {
        throw SceneError(fmt::format("{}: {}", typed, error.what()));
    }
    scene = changed;
}

}  // namespace strata::scene
