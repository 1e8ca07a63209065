// Random scenes and awkward values within the ranges of the key table.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "src/scene/keys.h"
#include "tests/support/random.h"

namespace strata::scene {

using support::Random;

inline double random_number(Range range, Random& random) {
    const double u = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    const double across = range.min + u * (range.max - range.min);
    const double near_zero = std::ldexp(u - 0.5, -static_cast<int>(random() % 60));
    const std::array<double, 7> candidates{
        range.min, range.max, across, near_zero, std::round(across), -0.0, std::nextafter(range.min, range.max)};
    const double pick = candidates[random() % candidates.size()];
    return pick >= range.min && pick <= range.max ? pick : across;
}

inline std::string random_text(Random& random) {
    constexpr std::array<const char*, 10> kPieces{"a",    "\"",   "\\",     "\n",     "\t",
                                                  "\x01", "\x7f", "\u00e9", "\u2603", "# ="};
    std::string text;
    for (auto left = random() % 12; left > 0; --left) text += kPieces[random() % kPieces.size()];
    return text;
}

inline void randomise(const Key& key, Random& random);

// Times increase; every part is there or not.
inline std::vector<CameraKey> random_camera_keys(Random& random) {
    std::vector<CameraKey> entries(random() % 6);
    double time = random_number({-1e3, 1e3}, random);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        CameraKey& entry = entries[i];
        Camera rest;
        for (const Key& key : describe_camera_key(entry, rest, i).keys) randomise(key, random);
        entry.time_s = time;
        time += 2e-6 + std::abs(random_number({0.0, 10.0}, random));
        if (random() % 2 == 0) entry.position = rest.position;
        if (random() % 2 == 0) entry.look_at = rest.look_at;
        if (random() % 2 == 0) entry.fov_deg = rest.fov_deg;
    }
    return entries;
}

inline void randomise(const Key& key, Random& random) {
    if (auto* entries = std::get_if<std::vector<CameraKey>*>(&key.field)) **entries = random_camera_keys(random);
    if (auto* flag = std::get_if<bool*>(&key.field)) **flag = random() % 2 == 0;
    if (auto* count = std::get_if<int*>(&key.field)) **count = static_cast<int>(random_number(key.range, random));
    if (auto* seed = std::get_if<std::uint64_t*>(&key.field)) **seed = random() % 4 == 0 ? kLargestSeed : random() >> 1;
    if (auto* number = std::get_if<double*>(&key.field)) **number = random_number(key.range, random);
    if (auto* rate = std::get_if<Rate*>(&key.field)) {
        **rate = random() % 2 == 0 ? Rate(random_number(key.range, random))
                                   : Rate::fraction(1 + static_cast<long long>(random() % 100'000), 1001);
    }
    if (auto* text = std::get_if<std::string*>(&key.field)) **text = random_text(random);
    if (auto* choice = std::get_if<Choice>(&key.field)) choice->set(random() % choice->names.size());
    if (auto* vector = std::get_if<glm::dvec3*>(&key.field)) {
        for (int i = 0; i < 3; ++i) (**vector)[i] = random_number(key.range, random);
        if (key.is_direction) (**vector)[static_cast<int>(random() % 3)] = 0.75;
    }
}

// Each key random with the given probability, else at its default.
inline Scene random_scene(Random& random, double probability) {
    Scene scene;
    std::bernoulli_distribution changed(probability);
    for (const Section& section : describe(scene)) {
        for (const Key& key : section.keys) {
            if (changed(random)) randomise(key, random);
        }
    }
    return scene;
}

}  // namespace strata::scene
