// What relief nodes (noise/relief/nodes) and solids (src/solid) tell their keys to: they know nothing of scenes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "noise/fbm.h"
#include "src/scene/keys.h"

namespace strata::scene {

class KeyList {
  public:
    void number(std::string name, double& field, double min, double max, std::string_view unit,
                std::string_view meaning) {
        add(std::move(name), &field, {min, max}, unit, meaning);
    }
    void count(std::string name, int& field, int min, int max, std::string_view meaning) {
        add(std::move(name), &field, {static_cast<double>(min), static_cast<double>(max)}, {}, meaning);
    }
    void vector(std::string name, glm::dvec3& field, double min, double max, std::string_view unit,
                std::string_view meaning) {
        add(std::move(name), &field, {min, max}, unit, meaning);
    }
    void numbers(std::string name, std::vector<double>& field, double min, double max, std::string_view unit,
                 std::string_view meaning) {
        add(std::move(name), &field, {min, max}, unit, meaning);
    }
    void seed(std::string name, std::uint64_t& field, std::string_view meaning) {
        add(std::move(name), &field, {}, {}, meaning);
    }

    // names: of the enumerators of E, in their order from 0.
    template <class E>
    void choice(std::string name, E& field, std::span<const std::string_view> names, std::string_view meaning) {
        add(std::move(name),
            Choice{names, [&field] { return static_cast<std::size_t>(field); },
                   [&field](std::size_t index) { field = static_cast<E>(index); }},
            {}, {}, meaning);
    }
    void octaves(noise::FbmParameters& p) {
        count("octaves", p.octaves, 1, noise::kMaxOctaves, "terms of its sum");
        number("lacunarity", p.lacunarity, 1.0, 10.0, "", "frequency ratio of neighbouring octaves");
        number("gain", p.gain, 0.0, 1.0, "", "amplitude ratio of neighbouring octaves");
        number("amplitude", p.amplitude, 0.0, 1e6, "surface units", "amplitude of octave 0");
        number("frequency", p.frequency, 1e-9, 1e9, "lattice cells a surface unit", "frequency of octave 0");
        seed("seed", p.seed, "chooses the noise");
    }
    void turn(double& degrees) {
        number("turn_deg", degrees, -360.0, 360.0, "degrees",
               "how far each octave's lattice is turned against the last; 36.87 hides lattices");
    }

    void add(Key key) { keys_.push_back(std::move(key)); }
    std::vector<Key> take() { return std::move(keys_); }

  private:
    void add(std::string name, Field field, Range range, std::string_view unit, std::string_view meaning) {
        keys_.push_back({.section = {},
                         .name = std::move(name),
                         .field = std::move(field),
                         .range = range,
                         .unit = unit,
                         .meaning = meaning});
    }

    std::vector<Key> keys_;
};

}  // namespace strata::scene
