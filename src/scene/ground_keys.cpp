#include "src/scene/ground_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/scene/key_makers.h"
#include "src/scene/key_text.h"
#include "src/scene/named_list.h"

namespace strata::scene {

namespace {

constexpr Range kSize{1e-6, 1e9}, kShare{0.0, 1.0}, kEdge{1e-6, 1e9};
constexpr int kMostWarpOctaves = 3;

std::span<const std::string_view> kind_names() {
    static const auto kNames = [] {
        std::array<std::string_view, kGroundKinds> names;
        for (std::size_t i = 0; i < names.size(); ++i) names[i] = ground_palette()[i].name;
        return names;
    }();
    return kNames;
}

class GroundKeyList {
  public:
    template <class FieldType>
    void add(std::string name, FieldType field, Range range, std::string_view unit, std::string_view meaning) {
        keys_.push_back(key_makers::key(std::move(name), std::move(field), range, unit, meaning));
    }
    void kind(std::string name, GroundKind& field, std::string_view meaning) {
        add(std::move(name),
            Choice{kind_names(), [&field] { return static_cast<std::size_t>(field); },
                   [&field](std::size_t i) { field = static_cast<GroundKind>(i); }},
            {}, "", meaning);
    }
    void range(const std::string& name, SoftRange& field, Range allowed, std::string_view unit,
               std::array<std::string_view, 3> meanings) {
        const std::string suffix = unit == "degrees" ? "_deg" : "";
        add(name + "_from" + suffix, &field.from, allowed, unit, meanings[0]);
        add(name + "_to" + suffix, &field.to, allowed, unit, meanings[1]);
        add(name + "_edge" + suffix, &field.edge, kEdge, unit, meanings[2]);
    }
    void noise(const std::string& name, GroundNoise& noise) {
        add(name + "_size", &noise.size, kSize, "surface units", "cells of its coarsest octave");
        add(name + "_stretch", &noise.stretch, {1e-3, 1e3}, "", "how much longer it is along y: streaks down walls");
        octaves(name, noise.octaves, noise.gain, noise.seed);
    }
    void octaves(const std::string& name, int& octaves, double& gain, std::uint64_t& seed) {
        add(name + "_octaves", &octaves, {1, 16}, "", "terms of its sum, each twice as fine");
        add(name + "_gain", &gain, kShare, "", "amplitude ratio of neighbouring octaves");
        add(name + "_seed", &seed, {}, "", "chooses the noise; equal ones are equal noises");
    }
    std::vector<Key> take() { return std::move(keys_); }

  private:
    std::vector<Key> keys_;
};

void colour_keys(GroundLayer& layer, GroundKeyList& list) {
    constexpr std::string_view kColour = "linear red, green, blue";
    list.kind("kind", layer.kind, "what it is: its reflectance; own is `colour`");
    list.add("colour", &layer.colour, kShare, kColour, "reflectance of the kind own");
    list.add("tone", &layer.tone, kShare, "", "largest share of the second colour, which a noise mixes in");
    list.kind("second", layer.second, "the second colour's kind; own is `second_colour`");
    list.add("second_colour", &layer.second_colour, kShare, kColour, "second reflectance of the kind own");
    list.noise("tone", layer.tone_noise);
    list.add("roughness", &layer.roughness, kShare, "",
             "of its grain: 0 is Lambert, 1 the flattest under a light from behind the eye (Oren-Nayar)");
}

void mask_keys(GroundLayer& layer, GroundKeyList& list) {
    list.add("cover", &layer.cover, kShare, "", "its share where it lies");
    list.range("height", layer.height, {-kEndOfHeights, kEndOfHeights}, "surface units",
               {"lowest over the base plane or sphere", "highest over the base", "height over which it ends"});
    list.add("height_noise", &layer.height_noise, {0.0, kEndOfHeights}, "surface units",
             "how far the noise moves these ends, root mean square");
    list.range("slope", layer.slope_deg, {0.0, 180.0}, "degrees",
               {"gentlest slope; 90 is a wall, more overhangs", "steepest slope", "slopes over which it ends"});
    list.add("slope_noise_deg", &layer.slope_noise_deg, {0.0, 180.0}, "degrees",
             "how far the noise moves these ends, root mean square");
    list.add("aspect", &layer.aspect, {-1e12, 1e12}, "", "direction for facing, by the surface's axes");
    list.range("facing", layer.facing, {-1.0, 1.0}, "sine of the slope",
               {"least part of the normal along aspect: 0 is level ground and slopes across, 1 a wall that faces it",
                "most part of the normal along aspect", "of that part, over which it ends"});
    list.range("noise", layer.patches, {-kEndOfNoise, kEndOfNoise}, "root mean squares",
               {"least value of the noise: patches; 0 covers half, 1 a sixth", "greatest value of the noise",
                "of its values, over which it ends"});
    list.noise("noise", layer.noise);
}

void strata_keys(GroundLayer& layer, GroundKeyList& list) {
    GroundStrata& strata = layer.strata;
    list.range("strata", layer.beds, {-kEndOfNoise, kEndOfNoise}, "root mean squares",
               {"least value of the beds' noise, which follows height: 0 covers half, 1 a sixth",
                "greatest value of the beds' noise", "of its values, over which it ends: small is hard"});
    list.add("strata_thickness", &strata.thickness, kSize, "surface units", "of the thickest beds");
    list.add("strata_length", &strata.length, kSize, "surface units", "how far beds go before others follow");
    list.add("strata_warp", &strata.warp, {0.0, 1e9}, "surface units", "how far beds rise and sink, root mean square");
    list.add("strata_warp_size", &strata.warp_size, kSize, "surface units", "over which they do");
    list.octaves("strata", strata.octaves, strata.gain, strata.seed);
}

// Keys of a layer that are not as by default, of those that say where it lies.
std::string first_mask_key(GroundLayer layer) {
    GroundLayer standard;
    GroundKeyList set, defaults;
    mask_keys(layer, set);
    strata_keys(layer, set);
    mask_keys(standard, defaults);
    strata_keys(standard, defaults);
    const std::vector<Key> keys = set.take(), of_defaults = defaults.take();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (value_text(keys[i]) != value_text(of_defaults[i])) return keys[i].name;
    }
    return {};
}

std::string range_problem(const GroundLayer& layer) {
    struct Named {
        const SoftRange& range;
        std::string_view from, to;
    };
    for (const Named& named :
         {Named{layer.height, "height_from", "height_to"}, Named{layer.slope_deg, "slope_from_deg", "slope_to_deg"},
          Named{layer.facing, "facing_from", "facing_to"}, Named{layer.patches, "noise_from", "noise_to"},
          Named{layer.beds, "strata_from", "strata_to"}}) {
        if (named.range.from < named.range.to) continue;
        return fmt::format("ground.{}.{}: not below {} ({}, {}), allowed: less than that", layer.name, named.from,
                           named.to, number_text(named.range.from), number_text(named.range.to));
    }
    return {};
}

}  // namespace

Section describe_ground_layer(GroundLayer& layer) {
    GroundKeyList list;
    list.add("name", &layer.name, {}, "", "what messages and --set call it");
    colour_keys(layer, list);
    mask_keys(layer, list);
    strata_keys(layer, list);
    Section section{"ground." + layer.name, "a layer of ground over those before it", list.take(), true};
    for (Key& key : section.keys) {
        key.section = section.name;
        key.is_direction = key.name == "aspect";
    }
    return section;
}

double finest_ground_cells(const GroundLayer& layer) {
    const auto has_ends = [](const SoftRange& range, double least, double most) {
        return range.from > least || range.to < most;
    };
    const auto finest = [](double size, int octaves) { return std::ldexp(1.0 / size, octaves - 1); };
    const auto of_noise = [&](const GroundNoise& noise) {
        return finest(noise.size * std::min(noise.stretch, 1.0), noise.octaves);
    };
    double cells = 0.0;
    if (layer.tone > 0.0) cells = of_noise(layer.tone_noise);
    if (layer.height_noise > 0.0 || layer.slope_noise_deg > 0.0 || has_ends(layer.patches, -kEndOfNoise, kEndOfNoise))
        cells = std::max(cells, of_noise(layer.noise));
    if (has_ends(layer.beds, -kEndOfNoise, kEndOfNoise)) {
        const GroundStrata& strata = layer.strata;
        // Beds lie along height and across: the sum of both.
        cells = std::max(cells, finest(std::min(strata.thickness, strata.length), strata.octaves + 1));
        if (strata.warp > 0.0) cells = std::max(cells, finest(strata.warp_size, kMostWarpOctaves));
    }
    return cells;
}

std::string ground_problem(std::span<const GroundLayer> layers, std::size_t i) {
    const GroundLayer& layer = layers[i];
    if (std::string problem = name_problem("ground", layers, i); !problem.empty()) return problem;
    if (i == 0) {
        if (const std::string key = first_mask_key(layer); !key.empty()) {
            return fmt::format(
                "ground.{}.{}: the first layer lies everywhere, allowed: its colours and roughness, or a layer before "
                "it",
                layer.name, key);
        }
    }
    return range_problem(layer);
}

}  // namespace strata::scene
