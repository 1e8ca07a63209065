// How keys are described, one a line: for the files that list them (keys.cpp, pattern_keys.cpp).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/scene/enum_names.h"
#include "src/scene/keys.h"

namespace strata::scene::key_makers {

inline constexpr Range kAnywhere{-1e12, 1e12};
inline constexpr Range kLength{1e-9, 1e9};
inline constexpr Range kDistance{1e-12, 1e12};
inline constexpr Range kLight{0.0, 1e6};
inline constexpr Range kReflectance{0.0, 1.0};
inline constexpr Range kFraction{0.0, 1.0};
inline constexpr Range kAngle{-1e6, 1e6};

// Of any type that a key's field may have.
template <class Field>
Key key(std::string name, Field field, Range range, std::string_view unit, std::string_view meaning) {
    return {.section = {},
            .name = std::move(name),
            .field = std::move(field),
            .range = range,
            .unit = unit,
            .meaning = meaning};
}

inline Key number(std::string name, double& field, Range range, std::string_view unit, std::string_view meaning) {
    return key(std::move(name), &field, range, unit, meaning);
}

inline Key count(std::string name, int& field, Range range, std::string_view unit, std::string_view meaning) {
    return key(std::move(name), &field, range, unit, meaning);
}

inline Key vector(std::string name, glm::dvec3& field, Range range, std::string_view unit, std::string_view meaning) {
    return key(std::move(name), &field, range, unit, meaning);
}

inline Key direction(std::string name, glm::dvec3& field, std::string_view meaning) {
    Key made = vector(std::move(name), field, kAnywhere, "", meaning);
    made.is_direction = true;
    return made;
}

inline Key colour(std::string name, glm::dvec3& field, Range range, std::string_view meaning) {
    return vector(std::move(name), field, range, "linear red, green, blue", meaning);
}

// Of what has neither range nor unit: seeds, flags, texts, lists.
template <class Field>
Key plain(std::string name, Field& field, std::string_view meaning) {
    return key(std::move(name), &field, {}, {}, meaning);
}

template <class E>
Key choice(std::string name, E& field, std::string_view meaning) {
    Choice names{kEnumNames<E>, [&field] { return static_cast<std::size_t>(field); },
                 [&field](std::size_t index) { field = static_cast<E>(index); }};
    return key(std::move(name), std::move(names), {}, {}, meaning);
}

inline Key only_if(bool matters, Key key) {
    key.matters = matters;
    return key;
}

inline Section section(std::string name, std::string_view meaning, bool matters, std::vector<Key> keys) {
    for (Key& key : keys) {
        key.section = name;
        key.matters = key.matters && matters;
    }
    return {std::move(name), meaning, std::move(keys), false};
}

}  // namespace strata::scene::key_makers
